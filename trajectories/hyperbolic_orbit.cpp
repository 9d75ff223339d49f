#include "trajectories/hyperbolic_orbit.h"

#include <cmath>

#include "trajectories/infinity.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"
#include "trajectories/short_number.h"
#include "trajectories/square.h"

namespace domefall {
namespace {

constexpr double kSlowest = 1e-9;        // of c
constexpr double kLeastOfLight = 1e-12;  // 1 - v

// Returns E^2 - 1 = v^2/(1 - v^2).
double excess_energy(double speed) { return square(speed) / ((1 - speed) * (1 + speed)); }

void require_speed(double speed) {
  require_at_least("v_inf", "fraction of c", speed, kSlowest, "slower is a parabolic orbit");
  require_below("v_inf", "fraction of c", speed, 1 - kLeastOfLight, "nothing outruns light");
}

// `over` is E^2 - 1 above that of the slowest orbit that turns at r_p.  Then
// w3 - w2 = (1 - 3 w2) over/((1 - 2 w2) L^2 w2 (w2 - w1)).
Geodesic turning_at(double periastron, double excess, double over) {
  const double w2 = 1 / periastron;
  const double l2 = (excess + 2 * w2) / ((1 - 2 * w2) * w2 * w2), l = std::sqrt(l2);
  // w1 and w3 have the sum 1/2 - w2 and the product -(E^2 - 1)/(2 L^2 w2).
  const double product = -excess / (2 * l2 * w2), half = (0.5 - w2) / 2;
  const double w1 = product / (half + std::sqrt(half * half - product));
  const double gap = (1 - 3 * w2) * over / ((1 - 2 * w2) * l2 * w2 * (w2 - w1));
  const OrbitConstants constants{std::sqrt(1 + excess), excess, l};
  return {OrbitCurve::scattered(constants, periastron, w1, std::max(gap, kLeastExcess)), 0,
          -kInfinity};
}

// Returns E^2 - 1 of the unstable circular orbit at r, which is negative beyond 4.
double barrier_energy(double r) { return (4 - r) / (r * (r - 3)); }

// Returns the radius of the unstable circular orbit that has the energy of the speed v at infinity.
// It is r = 2 (3 + e)/(1 + e) with e = sqrt(1 + 8 v^2).
double barrier_radius(double speed) {
  const double e = std::sqrt(1 + 8 * square(speed));
  return 2 * (3 + e) / (1 + e);
}

// Let L_c be the L of capture and w the top of its barrier, where P has a double zero.  At x = 1/r
// the P of any L is 2 L_c^2 (x - w)^2 (x + 2w - 1/2) - (L^2 - L_c^2) x^2 (1 - 2x).  `depth` is -P
// at the top of its own barrier.  L^2 - L_c^2 is taken from the excess, so that it keeps its
// digits.
Geodesic past_capture(double speed, double l, double excess) {
  const double critical = capture_angular_momentum(speed), w = 1 / barrier_radius(speed);
  const Barrier barrier = barrier_of(l);
  const double higher = square(critical) * excess * (2 + excess), off = barrier.w - w;
  const double depth = higher * square(barrier.w) * (1 - 2 * barrier.w) -
                       2 * square(critical * off) * (barrier.w + 2 * w - 0.5);
  const double energy = excess_energy(speed);
  return {scattered_orbit({std::sqrt(1 + energy), energy, l}, depth), 0, -kInfinity};
}

}  // namespace

double slowest_speed_at_infinity(double periastron) {
  return periastron >= 4 ? 0 : std::sqrt(4 - periastron) / (periastron - 2);
}

double capture_angular_momentum(double speed) {
  const double w = 1 / barrier_radius(speed);
  return std::sqrt((excess_energy(speed) + 2 * w) / (1 - 2 * w)) / w;
}

double capture_impact_parameter(double speed) {
  return capture_angular_momentum(speed) / std::sqrt(excess_energy(speed));
}

Geodesic hyperbolic_by_periastron(double speed, double periastron) {
  require_speed(speed);
  require_above("periastron", "units of M", periastron, kHyperbolicInnermost,
                "no orbit turns there");
  const double bound = slowest_speed_at_infinity(periastron);
  if (bound > 0)
    require_above("v_inf", "fraction of c", speed, bound,
                  "to turn at r = " + short_number(periastron) + " takes more than " +
                      short_number(bound * kLightSpeedKmPerS) + " km/s");
  const double energy = excess_energy(speed);
  // Near the bound b, v^2/(1 - v^2) - b^2/(1 - b^2) = (v^2 - b^2)/((1 - v^2)(1 - b^2)) does not
  // cancel.
  const double over =
      bound > 0 ? (speed - bound) * (speed + bound) * (1 + energy) * (1 + excess_energy(bound))
                : energy - barrier_energy(periastron);
  return turning_at(periastron, energy, over);
}

Geodesic hyperbolic_by_speed_excess(double periastron, double excess) {
  require_above("periastron", "units of M", periastron, kHyperbolicInnermost,
                "no orbit turns there");
  require_below("periastron", "units of M", periastron, 4, "from there on any speed is enough");
  require_at_least("excess", "of the speed over its bound, in parts", excess, kLeastExcess,
                   "the orbit would never leave its periastron");
  const double bound = slowest_speed_at_infinity(periastron), speed = bound * (1 + excess);
  require_speed(speed);
  const double energy = excess_energy(speed);
  return turning_at(
      periastron, energy,
      square(bound) * excess * (2 + excess) * (1 + energy) * (1 + excess_energy(bound)));
}

Geodesic hyperbolic_by_impact_parameter(double speed, double impact_parameter) {
  require_speed(speed);
  const double bound = capture_impact_parameter(speed);
  require_above("impact_parameter", "units of M", impact_parameter, bound,
                "at v_inf = " + short_number(speed) + " what comes closer is captured");
  return past_capture(speed, impact_parameter * std::sqrt(excess_energy(speed)),
                      (impact_parameter - bound) / bound);
}

Geodesic hyperbolic_by_impact_excess(double speed, double excess) {
  require_speed(speed);
  require_at_least("excess", "of the impact parameter over its bound, in parts", excess,
                   kLeastExcess, "the orbit would never leave its periastron");
  return past_capture(speed, capture_angular_momentum(speed) * (1 + excess), excess);
}

}  // namespace domefall
