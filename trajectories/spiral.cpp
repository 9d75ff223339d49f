#include "trajectories/spiral.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "trajectories/flight_table.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/square.h"
#include "trajectories/trajectory.h"
#include "trajectories/zero_between.h"

namespace domefall {
namespace {

double charge_squared(const Spacetime& spacetime) {
  const auto* hole = std::get_if<ChargedHole>(&spacetime.kind());
  return hole ? square(hole->charge) : 0;
}

// A Departure says how an observer leaves the orbits at r = from_r.  With w = 1/r and w_c of the
// circle from which the fall comes, a fall of that angular momentum L has
//
//   (dw/dphi)^2 = p + 2 h^2 (b h - c h^2 + y),   h = w - w_c,   b = 1 - 2 q^2 w_c,   c = q^2/2
//
// With w_s of the last stable orbit, 2y (1 - q^2 w_c) = 4 q^4 w_c^3 - 9 q^2 w_c^2 + 6 w_c - 1 is
// (w_c/w_s - 1) (1 + w_s w_c (4 q^4 (w_c + w_s) - 9 q^2)).  Without a charge y = (6 - r_c)/(2 r_c).
// where p = 0 is the fall that has come off the circle itself.  The push ends at h = `over`, and
// there its dw/dphi is twice the mean 1/angle of its whole way in w.  Then h = 2/angle^2 - y makes
// p = 0 for a push that begins at the circle.
struct Departure {
  Spacetime spacetime;
  double circle;  // r_c
  double y, b, c;
  double far;          // w_c - 1/from_r, >= 0
  double over;         // > 0
  double circled = 0;  // radians that are spent on the circle before

  Departure(const Spacetime& of, double from_r, double h) : spacetime(of), over(h) {
    const double stable = of.last_stable_orbit(), q2 = charge_squared(of);
    circle = std::min(from_r, stable);
    const double wc = 1 / circle, ws = 1 / stable;
    y = (stable - circle) / (2 * circle) * (1 + ws * wc * q2 * (4 * q2 * (wc + ws) - 9)) /
        (1 - q2 * wc);
    b = 1 - 2 * q2 * wc, c = q2 / 2;
    far = from_r > stable ? (from_r - stable) / (stable * from_r) : 0;
  }

  double rise() const { return far + over; }  // of w, during the push
  double angle() const { return std::sqrt(2 / (over * (b - c * over) + y)); }
  double slope() const { return 2 * rise() / angle(); }  // dw/dphi at its end
  // Returns d^2w/dphi^2.
  double bend() const { return over * (over * (3 * b - 4 * c * over) + 2 * y); }
  double p() const { return 4 * far * (far + 2 * over) / square(angle()); }

  // Returns the azimuth from the end of the push to the horizon.
  double angle_of_fall() const {
    const auto rate = [this](double log_h) {
      const double h = std::exp(log_h);
      return h / std::sqrt(p() + 2 * h * h * (h * (b - c * h) + y));
    };
    constexpr unsigned kDepth = 15;
    constexpr double kTolerance = 1e-14;
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        rate, std::log(over), std::log(farthest()), kDepth, kTolerance);
  }
  double farthest() const { return 1 / spacetime.horizon() - 1 / circle; }  // h at the horizon
};

// Returns the departure that takes `turning` radians to the horizon.  Those that push and fall do
// not take are spent on the circle.
Departure departure(const Spacetime& spacetime, double from_r, double turning) {
  // What has come this close to the circle whirls on it, by some 10 radians over sqrt(2y).
  constexpr double kClosest = 1e-4;
  const Departure any(spacetime, from_r, 1);
  const auto excess = [&](double log_h) {
    const Departure d(spacetime, from_r, std::exp(log_h));
    return d.angle() + d.angle_of_fall() - turning;
  };
  // With the second of these the push alone would take all of the angle.
  const double low = std::log(std::max(kClosest * any.y, (2 / square(turning) - any.y) / any.b));
  const double left = -excess(low), high = std::log(any.farthest());
  // Next to a large charge the engines alone need most of a turn.
  if (const double least = turning + excess(high); left <= 0 && least > turning)
    require_at_least("turns", "revolutions", turning / (2 * std::numbers::pi),
                     least / (2 * std::numbers::pi), "with fewer nothing is left of the orbit");
  Departure d(spacetime, from_r, std::exp(left > 0 ? low : zero_between(excess, low, high)));
  d.circled = std::max(0.0, left);
  return d;
}

OrbitConstants constants_of_circle(double r) {
  return {(r - 2) / std::sqrt(r * (r - 3)), (4 - r) / (r * (r - 3)), r / std::sqrt(r - 3)};
}

// Returns the free fall after a departure.  tau = 0 at its beginning.
Trajectory fall_after(const Departure& d) {
  if (const auto* hole = std::get_if<ChargedHole>(&d.spacetime.kind()))
    return ChargedOrbit::off_circle(*hole, d.circle, d.over,
                                    square(d.circle / d.spacetime.circling_time(d.circle)) * d.p());
  // An orbit that is closer to the one without end than this part of P does not differ from it.
  constexpr double kNothing = 1e-17;
  OrbitConstants c = constants_of_circle(d.circle);
  const double l2 = square(c.angular_momentum);
  const double least = kNothing * 2 * l2 * d.over * (d.over + d.y);
  const double more = l2 * d.p();
  if (more == 0) {
    const double parameter = std::asinh(std::sqrt(d.over * d.circle));
    return Geodesic(OrbitCurve::returning(c, d.circle, d.circle - 2, least), parameter, 0);
  }
  c.excess_energy += more;
  c.energy = std::sqrt(1 + c.excess_energy);
  if (c.excess_energy >= 0) {
    const OrbitCurve curve = OrbitCurve::unturned(c, false, 0.25, 0);
    return Geodesic(curve, curve.parameter(1 / (1 / d.circle + d.over), false), -kInfinity);
  }
  // Here P = 24 (h^3 + below^3), so that G of OrbitCurve::returning is least at h = below/2.
  const double below = std::cbrt(d.p() / 2), top = 1 / (1 / d.circle - below);
  const double parameter = std::asinh(std::sqrt((d.over + below) * top));
  return Geodesic(OrbitCurve::returning(c, top, top - 2, std::max(18 * square(below), least)),
                  parameter, 0);
}

// A Push is the part with engines, along x = 0 to 1 of its azimuth.  w rises by the part
// S = x^3 (a + b x + c x^2), whose first two derivatives are 0 at x = 0 and those of the fall at
// x = 1.  It rises throughout.
struct Push {
  Spacetime spacetime;
  double from_r, rise, angle, angular_momentum;  // L from 6 M inward
  double a, b, c;

  Push(double r, const Departure& d)
      : spacetime(d.spacetime),
        from_r(r),
        rise(d.rise()),
        angle(d.angle()),
        angular_momentum(d.circle / spacetime.circling_time(d.circle)) {
    const double slope = 2, bend = d.bend() * square(angle) / rise;
    c = bend / 2 + 6 - 3 * slope;
    b = slope - 3 - 2 * c;
    a = 1 - b - c;
  }

  double part(double x) const { return x * x * x * (a + x * (b + x * c)); }
  double r_at(double x) const { return from_r / (1 + from_r * rise * part(x)); }

  // A Motion is that of the observer there.
  struct Motion {
    double r, radial, tangential, energy;  // dr/dtau, r dphi/dtau, E
  };
  Motion at(double x) const {
    const double r = r_at(x);
    const double l =
        r > spacetime.last_stable_orbit() ? 1 / spacetime.circling_time(r) : angular_momentum / r;
    const double slope = x * x * (3 * a + x * (4 * b + x * 5 * c));
    const double radial = -r * l * rise * slope / angle;
    const double energy2 = square(radial) + spacetime.lapse_squared(r) * (1 + l * l);
    return {r, radial, l, std::sqrt(energy2)};
  }

  FlightTable::Times rates(double x) const {
    const Motion m = at(x);
    const double rate = angle * m.r / m.tangential;
    return {rate, rate * (1 + square(m.tangential)) / (m.energy - m.radial)};
  }

  // Returns x where r is passed, for a radius of the push.
  double where(double r) const {
    const double wanted = (from_r - r) / (from_r * r * rise);
    if (!(wanted > 0)) return 0;
    if (!(wanted < 1)) return 1;
    return zero_between([&](double x) { return part(x) - wanted; }, 0.0, 1.0);
  }

  // L has a kink in its second derivative at 6 M.
  FlightTable times() const {
    std::vector<double> kinks;
    const double stable = spacetime.last_stable_orbit();
    const double kink = from_r > stable ? 1 - where(stable) : 0;
    if (kink > 0 && kink < 1) kinks.push_back(kink);
    return {[this](double q) { return rates(1 - q); }, kinks};
  }
};

}  // namespace

struct Spiral::Tables {
  Trajectory circle;
  double circled;  // radians
  double pushed;   // proper time
  Push push;
  FlightTable times;
  Trajectory fall;
  double death;
  ProperTime released;  // as it is before `death`, which is rounded

  double null_at_push() const { return double(point_at(circle, pushed).null_time); }

  Tables(double from_r, const Departure& d)
      : circle(circle_at(d.spacetime, from_r)),
        circled(d.circled),
        pushed(circled / (2 * std::numbers::pi) *
               (2 * std::numbers::pi * from_r * d.spacetime.circling_time(from_r))),
        push(from_r, d),
        times(push.times()),
        fall(fall_after(d)),
        death(pushed + times.whole().tau + lifetime(fall)),
        released(std::holds_alternative<Geodesic>(fall) ? ProperTime(death) - lifetime(fall)
                                                        : exact_sum(pushed, times.whole().tau)) {}

  static Trajectory circle_at(const Spacetime& spacetime, double r) {
    if (const auto* hole = std::get_if<ChargedHole>(&spacetime.kind()))
      return ChargedCircle{*hole, r};
    return CircularOrbit{r};
  }
};

Spiral::Spiral(double from_r, double turns, const Spacetime& spacetime) {
  require_above("from_r", "units of M", from_r, spacetime.light_circle(),
                "at the light circle an orbit needs the speed of light");
  require_at_least("turns", "revolutions", turns, kFewestTurns,
                   "with fewer nothing is left of the orbit");
  if (turns > kMostTurns)
    require_below("turns", "revolutions", turns, kMostTurns, "more are a circular orbit");
  tables_ = std::make_shared<const Tables>(
      from_r, departure(spacetime, from_r, 2 * std::numbers::pi * turns));
}

double Spiral::death() const { return tables_->death; }
double Spiral::pushed() const { return tables_->pushed; }
ProperTime Spiral::released() const { return tables_->released; }
std::pair<double, double> Spiral::reach() const {
  return {domefall::reach(tables_->fall).first, tables_->push.from_r};
}

OrbitPoint Spiral::at(const ProperTime& tau) const {
  const Tables& t = *tables_;
  if (tau <= ProperTime(t.pushed)) return point_at(t.circle, tau);
  const DoubleDouble null_at_release = exact_sum(t.null_at_push(), t.times.whole().null_time);
  if (tau < t.released) {
    const double q = t.times.parameter(double(t.released - tau)), x = 1 - q;
    const Push::Motion m = t.push.at(x);
    return {Region::kI,
            Tetrad::kRain,
            m.r,
            t.circled + t.push.angle * x,
            {t.push.spacetime.moving_celerity(m.r, m.radial, m.tangential, false), 0, m.tangential},
            null_at_release - t.times.to_go(q).null_time};
  }
  OrbitPoint p = point_at(t.fall, tau - t.released);
  p.azimuth += t.circled + t.push.angle;
  p.null_time = p.null_time + null_at_release;
  return p;
}

std::optional<ProperTime> Spiral::time_at(double r, Leg leg, const ProperTime& after) const {
  const Tables& t = *tables_;
  if (leg == Leg::kOutward || !(r > 0) || r > t.push.from_r) return std::nullopt;
  std::optional<ProperTime> tau = t.pushed;
  if (r <= t.push.r_at(1)) {
    tau = domefall::time_at(t.fall, r, Leg::kInward);
    if (tau) tau = *tau + t.released;
  } else if (r < t.push.from_r) {
    tau = t.released - t.times.to_go(1 - t.push.where(r)).tau;
  }
  return tau && *tau >= after ? tau : std::nullopt;
}

}  // namespace domefall
