#include "tests/pipeline/render/disc/reference_disc.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <map>
#include <stdexcept>

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

// Light that left gas nearer than this to the past horizon (M) is not looked for.  Its redshift is
// about the inverse, a million or more.
constexpr double kPastHorizon = 1e-6;

double lapse_squared(double r, double charge) { return 1 - 2 / r + charge * charge / (r * r); }
double horizon(double charge) { return 1 + std::sqrt((1 - charge) * (1 + charge)); }

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 sum(const Vector3& a, double by, const Vector3& b) {
  return {a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]};
}

// ---- The ray ----

// A Light is the state of a ray: x, its rate of change back in time, and the change of v so far.
struct Light : std::array<double, 7> {
  Light() : std::array<double, 7>{} {}
  Vector3 place() const { return {(*this)[0], (*this)[1], (*this)[2]}; }
  Vector3 rate() const { return {(*this)[3], (*this)[4], (*this)[5]}; }
  double r() const { return std::sqrt(dot(place(), place())); }
  double outwards() const { return dot(place(), rate()) / r(); }  // -k^r
};

// Returns the wave vector, as frequency and frequency times direction of travel, in the frame of
// radial free fall.  The observer sees this light with frequency 1 from the direction m, so it is a
// Lorentz boost of (1, -m).
std::array<double, 4> boosted(const Vector3& celerity, const Vector3& m) {
  const double gamma = std::sqrt(1 + dot(celerity, celerity)), along = dot(celerity, m);
  std::array<double, 4> k{gamma - along, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    k[i + 1] = -m[i] - celerity[i] * along / (1 + gamma) + celerity[i];
  return k;
}

class IntegratedGeodesic {
 public:
  using Fehlberg78 =
      odeint::runge_kutta_fehlberg78<Light, double, Light, double, odeint::array_algebra>;

  IntegratedGeodesic(const ReferenceDiscView& view, const Vector3& direction)
      : charge_(view.charge) {
    const auto k = boosted(view.celerity, direction);
    // The Killing vector is d/dt = T + s R, or (1 + f)/2 T + (1 - f)/2 R near a charge, and E is its
    // product with the wave vector.  The frame itself moves against spheres of constant r, which
    // gives k^r.
    const double f = lapse_squared(view.r, charge_);
    const double along_t = charge_ > 0 ? (1 + f) / 2 : 1;
    const double s = (charge_ > 0 ? (1 - f) / 2 : std::sqrt(2 / view.r)) * (view.outgoing ? -1 : 1);
    energy_ = along_t * k[0] - s * k[1];
    const double radial = along_t * k[1] - s * k[0];
    light_[0] = view.r;
    light_[3] = -radial, light_[4] = -k[2], light_[5] = -k[3];
    // The rate is back in time, but h^2 = L^2 has no sign.
    const Vector3 spin = cross(light_.place(), light_.rate());
    spin2_ = dot(spin, spin);
  }

  double energy() const { return energy_; }
  double momentum_about(const Vector3& axis) const {  // of the light, which goes the other way
    return -dot(cross(light_.place(), light_.rate()), axis);
  }
  const Light& light() const { return light_; }

  void operator()(const Light& y, Light& rate, double /*lambda*/) const {
    const double r = y.r(), r5 = r * r * r * r * r;
    const double pull = (-3 + 2 * charge_ * charge_ / r) * spin2_ / r5;
    for (std::size_t i = 0; i < 3; ++i) {
      rate[i] = y[i + 3];
      rate[i + 3] = pull * y[i];
    }
    // Along the light dv/dlambda = (E + k^r)/f.  For light that falls this is 0/0 on the horizon, so
    // L^2/(r^2 (E - k^r)) is used, which is the same because E^2 - (k^r)^2 = f L^2/r^2.
    const double radial = -y.outwards();
    rate[6] = radial < 0 ? -spin2_ / (r * r * (energy_ - radial))
                         : -(energy_ + radial) / lapse_squared(r, charge_);
  }

  // Goes back along the ray by one step, and returns the state before it.
  Light step() {
    const Light before = light_;
    // No step covers more than a part of the way to the hole's centre.  Light that moves outwards
    // came from the past horizon, where v = -infinity, so its steps cover a part of that way.
    const double speed = std::sqrt(dot(light_.rate(), light_.rate()));
    const double way = light_.outwards() < 0 ? light_.r() - horizon(charge_) : light_.r();
    length_ = std::min(length_, 0.3 * way / speed);
    double lambda = 0;
    for (int tries = 0; tries < 100; ++tries) {
      if (stepper_.try_step(std::cref(*this), light_, lambda, length_) == odeint::success) {
        taken_ = lambda;
        return before;
      }
    }
    throw std::runtime_error("a ray beside the disc could not be followed");
  }
  // Makes the next step no longer than this part of r.
  void shorten(double part) {
    length_ = std::min(length_, part * light_.r() / std::sqrt(dot(light_.rate(), light_.rate())));
  }
  // Returns the length of the last step in lambda.
  double taken() const { return taken_; }
  // Returns the state after one step of any length up to the last one's, which is as exact as that.
  Light after(const Light& start, double length) const {
    Fehlberg78 one;
    Light out;
    one.do_step(std::cref(*this), start, 0.0, out, length);
    return out;
  }

 private:
  using Stepper = odeint::controlled_runge_kutta<Fehlberg78>;
  static constexpr double kTolerance = 1e-14;

  double charge_;
  Light light_;
  double energy_ = 0, spin2_ = 0, length_ = 1e-2, taken_ = 0;
  Stepper stepper_ = Stepper(Stepper::error_checker_type(kTolerance, kTolerance));
};

// Returns the state where the ray meets the plane between the two ends of a step, by bisection.  60
// halvings leave less than a double's last bit.
Light on_plane(const IntegratedGeodesic& ray, const Light& from, double length,
               const Vector3& normal) {
  double low = 0, high = length;
  const bool side = dot(ray.after(from, high).place(), normal) > 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    ((dot(ray.after(from, middle).place(), normal) > 0) == side ? high : low) = middle;
  }
  return ray.after(from, (low + high) / 2);
}

// ---- The gas ----

// A Gas has the circles of gas, whose E, L and Omega follow from the metric, and their last stable
// one.
class Gas {
 public:
  Gas(double charge, bool plunging) : q2_(charge * charge), plunging_(plunging) {
    // The cubic rises from below 0 at 3 to above it at 7.
    double low = 3, high = 7;
    for (int k = 0; k < 100; ++k) {
      const double r = (low + high) / 2;
      (r * (r * (r - 6) + 9 * q2_) - 4 * q2_ * q2_ < 0 ? low : high) = r;
    }
    edge_ = charge > 0 ? high : 6;
    greatest_ = flux(plunging ? edge_ : hottest());
  }

  double edge() const { return edge_; }
  double omega(double r) const { return std::sqrt(r - q2_) / (r * r); }
  double free(double r) const { return std::sqrt(1 - 3 / r + 2 * q2_ / (r * r)); }  // E - Omega L
  double momentum(double r) const { return std::sqrt(r - q2_) / free(r); }
  double energy(double r) const { return free(r) + omega(r) * momentum(r); }

  // Flux goes like the fourth power of temperature.  Below the last stable orbit the plunging gas
  // expands by the law of [Mummery & Balbus 2023], as in disc_light.h.
  double temperature(double r) const {
    if (r >= edge_) return std::pow(flux(r) / greatest_, 0.25);
    if (!plunging_) return 0;
    const auto start = [this](double at) { return std::sqrt(2 - q2_ * (3 / edge_ + 1 / at)); };
    const double fall = std::pow(edge_ / r - 1, 1.5) * start(r) / start(edge_);
    return std::pow(edge_ / r, 17.0 / 28) * std::pow(1 + fall / 0.01, -1.0 / 28);
  }

 private:
  // Returns the flux from a face of the disc, up to a constant factor.  The gas radiates what it
  // loses between r and the last stable orbit.  In [Page & Thorne 1974] that is the integral of
  // (E - Omega L) dL/dr, here by quadrature, over r (E - Omega L)^2/|dOmega/dr|.  The pull of
  // plunging gas adds 0.02 of the angular momentum of the last stable orbit, times E - Omega L.
  double flux(double r) const {
    const auto lost = [this](double x) {
      const double slowing = x * x - 3 * x + 2 * q2_;
      const double log_slope = 0.5 / (x - q2_) + 1 / x - (x - 1.5) / slowing;  // of L
      return free(x) * momentum(x) * log_slope;
    };
    const double brought = r > edge_
                               ? boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                                     lost, edge_, r, 12, 1e-13)
                               : 0;
    const double steeper = (3 * r - 4 * q2_) / (r * r * r * std::sqrt(r - q2_));  // 2 |dOmega/dr|
    const double pulled = plunging_ ? 0.02 * momentum(edge_) * free(edge_) : 0;
    return (brought + pulled) * steeper / (r * free(r) * free(r));
  }

  // Returns where the flux has its only maximum, by thirds.  100 steps leave (2/3)^100 = 2e-18 of
  // the distance.
  double hottest() const {
    double low = edge_ * 1.3, high = edge_ * 2;
    for (int k = 0; k < 100; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (flux(a) < flux(b) ? low : high) = flux(a) < flux(b) ? a : b;
    }
    return (low + high) / 2;
  }

  double q2_;
  bool plunging_;
  double edge_ = 0, greatest_ = 1;
};

// The quadratures of a gas are many, and views few.
const Gas& gas_of(const ReferenceDiscView& view) {
  static std::map<std::pair<double, bool>, Gas> known;
  return known.try_emplace({view.charge, view.plunging}, view.charge, view.plunging).first->second;
}

// Returns 1 + z = u.k for gas on a circle, u^t (E - Omega L).  Plunging gas keeps the energy and the
// angular momentum of the last stable orbit.  Its u^r follows from u.u = 1, and the product is
// (E_gas E - u^r k^r)/f - L_gas L/r^2.
double shift(const IntegratedGeodesic& ray, const Light& at, const ReferenceDiscView& view) {
  const Gas& gas = gas_of(view);
  const double r = at.r(), turned = ray.momentum_about(view.normal);
  if (r >= gas.edge()) return (ray.energy() - turned * gas.omega(r)) / gas.free(r);
  const double own = gas.energy(gas.edge()), spin = gas.momentum(gas.edge());
  const double f = lapse_squared(r, view.charge);
  const double fall = -std::sqrt(std::max(0.0, own * own - f * (1 + spin * spin / (r * r))));
  return (own * ray.energy() + fall * at.outwards()) / f - spin * turned / (r * r);
}

// Returns the azimuth (radians) of a place in the plane, from the part of R in the plane or, where
// R is the normal, from Theta's.
double azimuth_of(const Vector3& place, const Vector3& normal) {
  Vector3 first = sum({1, 0, 0}, -normal[0], normal);
  if (dot(first, first) < 1e-20) first = sum({0, 1, 0}, -normal[1], normal);
  return std::atan2(dot(cross(normal, first), place), dot(first, place));
}

}  // namespace

std::vector<ReferenceDiscPlace> reference_disc(const ReferenceDiscView& view,
                                               const Vector3& direction, int orders) {
  IntegratedGeodesic ray(view, direction);
  std::vector<ReferenceDiscPlace> found;
  // Light with E < 0 comes from region III.  An observer before the past horizon sees region IV
  // alone.
  const double end = horizon(view.charge);
  if (!(ray.energy() > 0) || (view.outgoing && view.r <= end)) return found;
  // An observer in the plane counts as being on the side to which the ray leads.
  double before_side = dot(ray.light().place(), view.normal);
  if (before_side == 0) before_side = dot(ray.light().rate(), view.normal);
  for (int order = 0; order < orders;) {
    const Light before = ray.step();
    const Light& now = ray.light();
    const double side = dot(now.place(), view.normal);
    if (side * before_side < 0) {
      const Light at = on_plane(ray, before, ray.taken(), view.normal);
      const double r = at.r();
      if (r > end && r >= view.inner && r <= view.outer) {
        // at[6] is v there less the observer's v, which is u + 2 r* of the observer.
        const double own = view.r + 2 * std::log(view.r / 2 - 1);
        const double sent = shift(ray, at, view);
        found.push_back({order, r, azimuth_of(at.place(), view.normal), sent,
                         std::abs(dot(at.rate(), view.normal)) / sent, gas_of(view).temperature(r),
                         -at[6] - (view.outgoing ? 2 * own : 0)});
      }
      ++order;
    }
    before_side = side;
    // The ray has come to the past horizon, or it leads to the sky and is beyond the disc.
    if (now.outwards() < 0 && now.r() < end + kPastHorizon) break;
    if (now.outwards() > 0 && now.r() > 3 && now.r() > view.outer) break;
  }
  return found;
}

std::vector<ReferenceGasStep> reference_steps(const ReferenceDiscView& view,
                                              const Vector3& direction, double outer, double part) {
  IntegratedGeodesic ray(view, direction);
  std::vector<ReferenceGasStep> steps;
  const double end = horizon(view.charge);
  if (!(ray.energy() > 0) || (view.outgoing && view.r <= end)) return steps;
  while (steps.size() < 1000000) {
    ray.shorten(part);
    const Light before = ray.step();
    const Light middle = ray.after(before, ray.taken() / 2);
    if (middle.r() > end)
      steps.push_back({middle.place(), middle.rate(), ray.energy(), ray.taken()});
    const Light& now = ray.light();
    if (now.outwards() < 0 && now.r() < end + kPastHorizon) break;
    if (now.outwards() > 0 && now.r() > 3 && now.r() > outer) break;
  }
  return steps;
}

}  // namespace domefall
