#include "trajectories/infall.h"

#include <cmath>
#include <stdexcept>

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_bounds.h"
#include "trajectories/orbit_search.h"
#include "trajectories/short_number.h"

namespace domefall {
namespace {

using FallKind = OrbitCurve::Kind;

// An energy below this part of gamma is what rounding leaves of 0.
constexpr double kNoEnergy = 1e-14;
const char* const kRadiusUnit = "units of M";

// Returns the parameter from which on the states are given in rain, which includes the throw.
double turn_of(const OrbitStart& start) {
  const FallKind kind = start.curve.kind();
  if (kind == FallKind::kEscaping) return start.parameter;
  return kind == FallKind::kReturning ? std::min(start.parameter, 0.0) : -kInfinity;
}

Geodesic geodesic_through(const OrbitConstants& constants, double r, double speed) {
  const OrbitStart start = orbit_through(constants, r, speed);
  return {start.curve, start.parameter, turn_of(start)};
}

void require_celerity(double radial, double tangential) {
  if (!std::isfinite(radial))
    throw std::domain_error("radial celerity must be a finite number (gamma v), got " +
                            short_number(radial));
  require_at_least("tangential celerity", "gamma v", tangential, 0,
                   "Phi is the direction of the motion");
}

}  // namespace

Geodesic fall_from_infinity(double angular_momentum, double from_r) {
  const double l = angular_momentum;
  require_above("start_r", kRadiusUnit, from_r, 0, "the singularity is there");
  require_at_least("angular_momentum", kRadiusUnit, l, 0, "it is a size");
  require_below("angular_momentum", kRadiusUnit, l, 4,
                "what falls from rest at infinity with more comes back");
  const double w = 1 / from_r, off = w - 0.25;
  return geodesic_through({1, 0, l}, from_r,
                          -std::sqrt(2 * w * (l * l * off * off + (4 - l) * (4 + l) / 16)));
}

Geodesic fall_with_speed(double speed, double impact_parameter, double from_r) {
  require_above("v_inf", "fraction of c", speed, 0, "from rest is fall_from_infinity");
  require_below("v_inf", "fraction of c", speed, 1, "nothing outruns light");
  require_above("start_r", kRadiusUnit, from_r, 0, "the singularity is there");
  require_at_least("impact_parameter", kRadiusUnit, impact_parameter, 0, "it is a size");
  require_below("impact_parameter", kRadiusUnit, impact_parameter, capture_impact_parameter(speed),
                "at v_inf = " + short_number(speed) + " what passes farther out comes back");
  const double excess = speed * speed / ((1 - speed) * (1 + speed)), w = 1 / from_r;
  const double l = impact_parameter * std::sqrt(excess);
  const double p = excess + w * (2 + l * l * w * (2 * w - 1));
  return geodesic_through({std::sqrt(1 + excess), excess, l}, from_r, -std::sqrt(p));
}

// An orbit from rest at r_a falls in if G of OrbitCurve::returning is positive all the way.  Its
// least value is G(w_a) for r_a <= 6, and beyond that G at w_m = (1 - 2 w_a)/4.  The bound is the L
// at which that is 0.
double fall_bound(double from_r) {
  const double w = 1 / from_r;
  if (from_r <= 3) return kInfinity;
  if (from_r <= 6) return 1 / std::sqrt(w * (1 - 3 * w));
  return 4 / std::sqrt((1 - 2 * w) * (1 + 6 * w));
}

Geodesic fall_from_rest(double from_r, double angular_momentum) {
  const double l = angular_momentum;
  require_above("start_r", kRadiusUnit, from_r, 2, "nothing rests at the horizon or inside");
  require_at_least("angular_momentum", kRadiusUnit, l, 0, "it is a size");
  require_below("angular_momentum", kRadiusUnit, l, fall_bound(from_r),
                "with more, what starts at r = " + short_number(from_r) + " does not fall in");
  const double w = 1 / from_r, over_two = from_r - 2;
  const double excess = w * (l * l * w * (1 - 2 * w) - 2);
  const double energy = std::sqrt(over_two * w * (1 + l * l * w * w));
  const double g =
      from_r <= 6 ? 2 - 2 * l * l * w * (1 - 3 * w) : 2 - l * l * (1 - 2 * w) * (1 + 6 * w) / 8;
  return {OrbitCurve::returning({energy, excess, l}, from_r, over_two, std::max(g, kLeastExcess)),
          0, 0};
}

Geodesic thrown_outside(double r, double radial, double tangential) {
  require_above("r", kRadiusUnit, r, 2, "nothing rests at the horizon or inside, to throw from");
  require_celerity(radial, tangential);
  const double f = Schwarzschild::lapse_squared(r), u2 = radial * radial + tangential * tangential;
  const OrbitConstants constants{std::sqrt((1 + u2) * f), u2 * f - 2 / r, r * tangential};
  return geodesic_through(constants, r, radial * std::sqrt(f));
}

Geodesic thrown_from_rain(double r, double radial, double tangential) {
  require_above("r", kRadiusUnit, r, 0, "the singularity is there");
  require_celerity(radial, tangential);
  const double s = Schwarzschild::free_fall_speed(r),
               gamma = std::hypot(1, std::hypot(radial, tangential));
  const double exact = gamma - s * radial;
  const double energy = std::abs(exact) < kNoEnergy * gamma ? 0 : exact;
  const OrbitConstants constants{std::abs(energy), (energy - 1) * (energy + 1), r * tangential};
  const Geodesic thrown = geodesic_through(constants, r, radial - s * gamma);
  return energy < 0 ? mirrored(thrown) : thrown;
}

}  // namespace domefall
