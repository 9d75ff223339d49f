#include "trajectories/charged_orbit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "trajectories/flight_table.h"
#include "trajectories/short_number.h"
#include "trajectories/square.h"

namespace domefall {
namespace {

constexpr double kOutermost = 1e10;  // M

using Others = ChargedTurns::Others;

// Returns s where r - near = above and far - r = below.
double curve_parameter(const ChargedTurns& t, double above, double below) {
  if (!t.is_bound()) return std::asinh(std::sqrt(above / t.near));
  return 2 * std::atan2(std::sqrt(above), std::sqrt(below));
}

// A Whirl says where along s an orbit whirls or is quick, and in how small a part of s, which is the
// distance of the zero of Q, of r or of E + dr/dtau beside it.  With s = at + width sinh x all is slow
// along x.
struct Whirl {
  double at = 0, width = 100;
};

Whirl whirl_of(const ChargedTurns& t) {
  constexpr double pi = std::numbers::pi;
  Whirl whirl;
  const auto narrow = [&whirl](double at, double width) {
    if (width < whirl.width) whirl = {at, width};
  };
  if (t.is_bound()) {
    const double rest = t.rest(1 / t.near - t.w1, 0, t.w1 - t.middle);  // at the apoastron
    narrow(pi, 2 * t.energy * t.far / t.width * std::sqrt(t.near * t.far / rest));
  }
  const double stretch = 2 * std::sqrt(t.gap / t.width);
  if (t.others == Others::kInside) {
    narrow(0, t.is_bound() ? t.near * stretch : std::sqrt(t.gap * t.near));
  } else if (t.others == Others::kBeyond) {
    narrow(pi, t.far * stretch);
  } else if (t.middle > std::max(0.0, t.w1) && t.middle * t.near < 1) {
    const double r = 1 / t.middle, s = curve_parameter(t, r - t.near, std::max(0.0, t.far - r));
    const double rise = t.is_bound() ? t.width * std::sin(s) / 2 : t.near * std::sinh(2 * s);
    narrow(s, std::sqrt(t.lead / t.a) / (rise * square(t.middle)));
  }
  // Panels of their own resolve a periastron that is far inside, if less well.
  constexpr double kWide = 0.03;
  if (t.is_bound() && whirl.width > kWide) narrow(0, 2 * std::sqrt(t.near / t.width));
  return whirl;
}

}  // namespace

// The parameter is q of FlightTable, 0 at the periastron and 1 at the far end of the table.
struct ChargedOrbit::Tables {
  ChargedTurns turns;
  Whirl whirl;
  double first, last;  // x at both ends
  double star_near;    // r* at the periastron
  FlightTable times;   // from there, of u where r grows

  explicit Tables(const ChargedTurns& of)
      : turns(of),
        whirl(whirl_of(turns)),
        first(-std::asinh(whirl.at / whirl.width)),
        last(std::asinh((span() - whirl.at) / whirl.width)),
        star_near(turns.hole.tortoise(turns.near)),
        times([this](double q) { return rates(q); }, {},
              // Rounding of x grows with its range.
              FlightTable::kTolerance * std::max(1.0, last - first)) {}

  bool passes() const { return turns.near < turns.hole.horizon(); }
  double period() const { return 2 * times.whole().tau; }

  struct Place {
    double r, radial, rate;  // dr/dtau >= 0, dtau/dq
  };
  Place place(double q) const;
  // Returns q where r - near = above and far - r = below.
  double where(double above, double below) const;
  double where(double r) const {
    return where(std::max(0.0, r - turns.near), std::max(0.0, turns.far - r));
  }

 private:
  double span() const {
    return turns.is_bound() ? std::numbers::pi
                            : curve_parameter(turns, std::max(kOutermost, turns.near), kInfinity);
  }
  FlightTable::Times rates(double q) const {
    const Place p = place(q);
    const double turn = turns.l / p.r;
    return {p.rate, p.rate * (1 + square(turn)) / (turns.energy + p.radial), p.rate * turn / p.r};
  }
};

// Distances from where it whirls are taken from `off`, which has their digits, as s has those of the
// distance from the periastron, and `left` those from the apoastron.
ChargedOrbit::Tables::Place ChargedOrbit::Tables::place(double q) const {
  const ChargedTurns& t = turns;
  const double step = (last - first) * q, x = first + step, off = whirl.width * std::sinh(x);
  const double s = 2 * whirl.width * std::cosh(first + step / 2) * std::sinh(step / 2);
  const double ds = whirl.width * std::cosh(x) * (last - first);
  const bool around = t.others == Others::kComplex && whirl.at > 0 && whirl.at < std::numbers::pi;
  if (!t.is_bound()) {
    const double sine = std::sinh(s), r = t.near * (1 + square(sine)), above = 1 / r - t.w1;
    const double from_middle =
        around ? -t.near * std::sinh(off) * std::sinh(s + whirl.at) * t.middle / r
               : 1 / r - t.middle;
    const double root = std::sqrt(above * t.rest(square(sine) / r, above, from_middle));
    return {r, sine * root / std::sqrt(r), ds * 2 * r * std::sqrt(t.near) / root};
  }
  const double to_go = (last - first) * (1 - q),
               left = 2 * whirl.width * std::cosh(last - to_go / 2) * std::sinh(to_go / 2);
  const double sine = std::sin(s / 2), cosine = std::sin(left / 2);
  const double r = t.near + t.width * square(sine);
  const double from_middle =
      around ? -t.width * std::sin(off / 2) * std::sin((s + whirl.at) / 2) * t.middle / r
             : 1 / r - t.middle;
  const double rest = t.rest(t.width * square(sine) / (r * t.near),
                             t.width * square(cosine) / (r * t.far), from_middle);
  const double root = std::sqrt(rest / (t.near * t.far));
  return {r, t.width * sine * cosine * root / r, ds * r / root};
}

double ChargedOrbit::Tables::where(double above, double below) const {
  const bool from_far = whirl.at == std::numbers::pi;
  const double off = from_far ? -2 * std::atan2(std::sqrt(below), std::sqrt(above))
                              : curve_parameter(turns, above, below) - whirl.at;
  return std::clamp((std::asinh(off / whirl.width) - first) / (last - first), 0.0, 1.0);
}

ChargedOrbit::ChargedOrbit(const ChargedTurns& turns)
    : tables_(std::make_shared<const Tables>(turns)) {}

ChargedOrbit ChargedOrbit::counted_from(const ChargedTurns& turns, double above, double below,
                                        Leg leg) {
  ChargedOrbit orbit(turns);
  const double q = orbit.tables_->where(above, below),
               from_periastron = orbit.tables_->times.to_go(q).tau;
  orbit.start_ = leg == Leg::kOutward ? from_periastron : -from_periastron;
  orbit.rises_ = leg == Leg::kOutward && turns.near + above > turns.hole.horizon();
  const OrbitPoint point = orbit.own_point(orbit.start_);
  orbit.start_azimuth_ = point.azimuth;
  orbit.start_null_time_ = point.null_time;
  orbit.start_universe_ = point.universe;
  return orbit;
}

double ChargedOrbit::energy() const { return tables_->turns.energy; }
double ChargedOrbit::angular_momentum() const { return tables_->turns.l; }
double ChargedOrbit::innermost() const { return tables_->turns.near; }
double ChargedOrbit::outermost() const { return tables_->turns.far; }
bool ChargedOrbit::passes() const { return tables_->passes(); }
double ChargedOrbit::radial_period() const {
  return tables_->turns.is_bound() ? tables_->period() : kInfinity;
}
double ChargedOrbit::birth() const {
  return tables_->turns.is_bound() ? -kInfinity : double(-start_ - tables_->times.whole().tau);
}
double ChargedOrbit::death() const {
  return tables_->turns.is_bound() ? kInfinity : double(-start_ + tables_->times.whole().tau);
}

OrbitPoint ChargedOrbit::at(const ProperTime& tau) const {
  OrbitPoint point = own_point(tau + start_);
  point.azimuth -= start_azimuth_;
  point.null_time = point.null_time - start_null_time_;
  point.universe -= start_universe_;
  return point;
}

OrbitPoint ChargedOrbit::own_point(const ProperTime& own) const {
  const Tables& t = *tables_;
  const ChargedHole& hole = t.turns.hole;
  const FlightTable::Times whole = t.times.whole();
  ProperTime in_turn = own;
  double turns = 0;
  if (t.turns.is_bound()) {
    turns = std::floor(double(own) / t.period() + 0.5);
    in_turn = own - exact_product(turns, t.period());
  } else if (!(std::abs(double(own)) <= whole.tau)) {
    throw std::domain_error("proper time " + short_number(double(own - start_)) +
                            " (units of M) is beyond the orbit's ends");
  }
  const bool grows = double(in_turn) >= 0;
  const double side = grows ? 1 : -1, q = t.times.parameter(std::abs(double(in_turn)));
  const Tables::Place p = t.place(q);
  const FlightTable::Times sums = t.times.to_go(q);
  const bool passed = t.passes() && grows;
  // What rises from its beginning outside is in rain.
  const bool rises = rises_ && turns == 0 && own >= start_;
  OrbitPoint point;
  point.r = p.r;
  point.tetrad = passed && !rises ? Tetrad::kOutgoing : Tetrad::kRain;
  point.region = p.r > hole.horizon()         ? Region::kI
                 : p.r < hole.inner_horizon() ? Region::kV
                 : passed                     ? Region::kIV
                                              : Region::kII;
  point.universe =
      t.passes() ? static_cast<int>(turns) + (passed && point.region != Region::kV) : 0;
  point.azimuth = side * sums.azimuth + 2 * turns * whole.azimuth;
  const double turn = t.turns.l / p.r;
  const bool outgoing = is_outgoing(point.tetrad);
  point.celerity = {
      hole.radial_celerity(hole.at(p.r), side * p.radial, t.turns.energy, square(turn), outgoing),
      0, turn};
  // t is 0 at the periastron.
  double time = side * (sums.null_time - t.star_near);
  if (grows && !outgoing) time += 2 * hole.tortoise(p.r);
  point.null_time = time;
  if (turns != 0)
    point.null_time =
        point.null_time +
        exact_product(2 * turns, whole.null_time + hole.tortoise(t.turns.far) - t.star_near);
  return point;
}

std::optional<ProperTime> ChargedOrbit::time_at(double r, Leg leg, const ProperTime& after) const {
  const Tables& t = *tables_;
  if (!(r >= t.turns.near && r <= t.turns.far && r <= kOutermost)) return std::nullopt;
  const double side = leg == Leg::kOutward ? 1 : -1;
  ProperTime own = side * t.times.to_go(t.where(r)).tau;
  if (t.turns.is_bound()) {
    const ProperTime start = after == -kInfinity ? -t.period() / 2 : after + start_;
    own = own + exact_product(std::ceil(double(start - own) / t.period()), t.period());
    if (own < start) own = own + t.period();
  }
  const ProperTime tau = own - start_;
  return t.turns.is_bound() || tau >= after ? std::optional(tau) : std::nullopt;
}

std::optional<ProperTime> ChargedOrbit::next_periastron(const ProperTime& after) const {
  return time_at(innermost(), Leg::kOutward, after);
}

double period(const ChargedCircle& orbit) {
  return 2 * std::numbers::pi * orbit.r * orbit.hole.circling_time(orbit.r);
}

OrbitPoint ChargedCircle::at(const ProperTime& tau) const {
  const double turning = 1 / hole.circling_time(r), f = hole.lapse_squared(r);
  // E = f dt/dtau.
  const double time_rate = std::sqrt((1 + square(turning)) / f);
  return {Region::kI,
          Tetrad::kRain,
          r,
          double(tau) * turning / r,
          {hole.radial_celerity(hole.at(r), 0, f * time_rate, square(turning), false), 0, turning},
          double(tau) * time_rate};
}

}  // namespace domefall
