// The images of places in a wormhole.  Followed back from the observer, a ray runs along a WormholeLeg
// (wormhole_leg.h), on which azimuth and time are integrals.
#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "pipeline/light/half_angle.h"
#include "pipeline/light/place_image.h"
#include "pipeline/light/wormhole_ray.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;
using std::numbers::pi;

// A Stretch is a part of a ray: from one u of its leg to another, or a length of l in the cylinder.
struct Stretch {
  double from, to;
  double cylinder = 0;
};

// A Way leads from the observer back to the place.
struct Way {
  ThroatRay ray;
  WormholeLeg leg;
  double u_to;    // of the place
  bool rises;     // |l| grows at the place
  double beyond;  // how far l is passed outside the cylinder, on all stretches together
  std::vector<Stretch> stretches;
};

// Where a ray meets the place: on the way that it begins with, or after it has turned.
enum class Meeting { kFirst, kAfterTurn };

// The rays of an observer at l >= 0 that come from a place at l_to, by their offset from the edge.
class WormholeFan {
 public:
  WormholeFan(const Wormhole& wormhole, double l, double l_to)
      : w_(wormhole), l_(l), l_to_(l_to), above_to_(wormhole.above_throat(l_to)) {}

  double edge() const {
    const EdgeAngle edge = edge_angle(w_, l_);
    return std::atan2(edge.sine, edge.cosine);
  }
  double r_to() const { return 1 + above_to_; }

  Way way(double offset, Meeting meeting) const {
    const ThroatRay ray = throat_ray(w_, l_, offset);
    Way way{ray, WormholeLeg(w_, ray.b, ray.below), 0, false, 0, {}};
    const double y = w_.beyond_mouth(l_), y_to = w_.beyond_mouth(l_to_), a = w_.half_length();
    const double u = ray.start(way.leg, y);
    way.u_to = way.leg.parameter(y_to, std::max(0.0, above_to_ + ray.below));
    const bool passes = l_to_ < 0, turns = meeting == Meeting::kAfterTurn && ray.inward;
    way.rises = passes || turns || l_to_ > l_;
    if (passes || turns) {
      way.beyond = y + y_to - (turns ? 2 * way.leg.at(0).y : 0);
      way.stretches = {{u, 0}, {0, way.u_to}};
    } else {
      way.beyond = std::abs(y - y_to);
      way.stretches = {{u, way.u_to}};
    }
    const double cylinder = std::abs(std::clamp(l_, -a, a) - std::clamp(l_to_, -a, a));
    // It comes before the mouth through which the ray leaves it, and after the one by which it came.
    const auto place = way.stretches.begin() + (passes || !way.rises ? 1 : 0);
    if (cylinder > 0) way.stretches.insert(place, {0, 0, cylinder});
    return way;
  }

 private:
  Wormhole w_;
  double l_, l_to_, above_to_;
};

// Returns the integral of rate(place) du over the stretches, and in the cylinder of rate du/dl times
// `in_cylinder`.
template <class Rate>
double along(const Way& way, const Rate& rate, double in_cylinder) {
  double sum = 0;
  for (const Stretch& s : way.stretches)
    sum += s.cylinder > 0
               ? s.cylinder * in_cylinder
               : along_leg<12>(way.leg, std::min(s.from, s.to), std::max(s.from, s.to), rate);
  return sum;
}

double azimuth(const Way& way) {
  const double b = way.leg.impact();
  return along(
      way, [b](const WormholeLeg::Place& p) { return b * p.rate / (p.r * p.r); },
      b * way.leg.cylinder_rate());
}

// Returns how long the light takes.  Far away that is nearly the length of l.
double duration(const Way& way) {
  const double b = way.leg.impact();
  return way.beyond + along(
                          way,
                          [b](const WormholeLeg::Place& p) {
                            const double part = b / p.r;
                            return p.rate * part * part / (1 + std::sqrt(p.rise));
                          },
                          way.leg.cylinder_rate());
}

// Returns how far apart rays are at the place, within their plane and at right angles to them, per
// angle between them at the observer.  It obeys x'' = (r''/r) x in s, with x = 0 and x' = 1 there.
double spread(const Wormhole& w, const Way& way) {
  using State = std::array<double, 2>;
  constexpr double kTolerance = 1e-10, kFirstStep = 0.01;
  constexpr double kLeast = 1e-9;  // of u, whose rate is there as it is at a turn
  State x{0, 1};
  for (const Stretch& s : way.stretches) {
    if (s.cylinder > 0) {
      x[0] += x[1] * s.cylinder * way.leg.cylinder_rate();
      continue;
    }
    const double way_u = std::abs(s.to - s.from), sign = s.to > s.from ? 1 : -1;
    const auto rate = [&](const State& at, State& change, double passed) {
      const WormholeLeg::Place p = way.leg.at(std::max(kLeast, s.from + sign * passed));
      change = {at[1] * p.rate, at[0] * w.curvature_beyond(p.y) / p.r * p.rate};
    };
    if (way_u > 0)
      odeint::integrate_adaptive(
          odeint::make_controlled(kTolerance, kTolerance, odeint::runge_kutta_dopri5<State>()),
          rate, x, 0.0, way_u, std::min(kFirstStep, way_u));
  }
  return x[0];
}

// Finds the offset = sign exp(t) at which the azimuth is psi, from the edge to `reach`, over which it
// falls or rises all the way.
std::optional<Way> solve(const WormholeFan& fan, double psi, double sign, double reach,
                         Meeting meeting) {
  constexpr double kLeast = -690;  // of t; a double has hardly any less
  const auto excess = [&](double t) {
    return azimuth(fan.way(sign * std::min(std::exp(t), reach), meeting)) - psi;
  };
  // Most light is not next to the edge, where the azimuth takes the longest.
  double high = std::log(reach), at_high = excess(high), low = high, at_low = at_high;
  for (double step = 1; at_low * at_high > 0 && low > kLeast; step *= 2) {
    high = low, at_high = at_low;
    low = std::max(low - step, kLeast), at_low = excess(low);
  }
  if (!(at_low * at_high <= 0)) return std::nullopt;
  std::uintmax_t steps = 100;
  const auto [from, to] = boost::math::tools::toms748_solve(
      excess, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(44), steps);
  return fan.way(sign * std::min(std::exp((from + to) / 2), reach), meeting);
}

// Returns the way of the light that has swept psi >= 0.
std::optional<Way> find_way(const WormholeFan& fan, const Wormhole& w, double l, double l_to,
                            double psi) {
  constexpr double kRadial = 1e-9;
  const double edge = fan.edge();
  if (psi < kRadial) return fan.way(l_to > l ? pi - edge : -edge, Meeting::kFirst);
  if (l_to < 0) return solve(fan, psi, -1, edge, Meeting::kFirst);
  if (l_to > l) return solve(fan, psi, 1, pi - edge, Meeting::kAfterTurn);
  // The ray that turns at the place parts those that meet it before they turn from the others, and
  // the ray along the edge those that pass through the throat.
  const double turning = std::min(1.0, fan.r_to() / w.radius(l));
  const double touching = l_to > w.half_length() ? std::asin(turning) - edge : 0;
  if (!(touching > 0)) return solve(fan, psi, -1, edge, Meeting::kFirst);
  if (psi >= azimuth(fan.way(touching, Meeting::kFirst)))
    return solve(fan, psi, 1, touching, Meeting::kAfterTurn);
  if (auto passing = solve(fan, psi, -1, edge, Meeting::kFirst)) return passing;
  return solve(fan, psi, 1, touching, Meeting::kFirst);
}

}  // namespace

std::optional<PlaceLight> image_of_place(const WormholePlaceView& view, double l, double psi,
                                         double blur) {
  // The other side is the mirror image.
  const double side = view.l < 0 ? -1 : 1, near = side * view.l, far = side * l;
  const Wormhole& w = view.wormhole;
  const WormholeFan fan(w, near, far);
  const auto way = find_way(fan, w, near, far, psi);
  if (!way) return std::nullopt;
  const ThroatRay& ray = way->ray;
  const double apart = spread(w, *way), r = fan.r_to();
  if (!(apart > 0)) return std::nullopt;  // the place is the observer's own
  // dl/ds in the sense in which light is followed back.
  const double speed = std::sqrt(way->leg.at(way->u_to).rise);
  const bool away = far < 0 ? side < 0 : way->rises == (side > 0);
  PlaceLight light;
  const HalfAngle half = half_angle(side * ray.cosine, ray.sine);
  light.sin_half = half.sine;
  light.cos_half = half.cosine;
  light.energy = 1;
  light.angular_momentum = psi > 0 ? ray.b : 0;
  light.null_time = (l - view.l) - duration(*way);
  const double slope = away ? speed : -speed;
  if (ray.b > 0) light.slope = slope * r * r / ray.b;
  // Light that has hardly swept anything meets no caustic.
  const double swept = psi < pi ? std::sin(psi / 2) : 1;
  const double sine = std::hypot(std::sin(psi), blur * swept * swept);
  light.solid_angle_per_area = sine > 0 ? ray.sine / (sine * apart * r) : 1 / (apart * apart);
  light.angle_per_length = 1 / apart;
  light.angle_per_psi = -slope * r / apart;
  return light;
}

}  // namespace domefall
