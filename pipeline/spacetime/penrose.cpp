#include "pipeline/spacetime/penrose.h"

#include <cmath>
#include <numbers>

#include "pipeline/spacetime/kruskal.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

// Returns arctan(exp(log)), which is in (0, pi/2), even where exp(log) overflows.  It is 0 where
// log is minus infinity.
double arctan_exp(double log) {
  return log > 0 ? std::numbers::pi / 2 - std::atan(std::exp(-log)) : std::atan(std::exp(log));
}

PenrosePoint compactified(Region region, double log_u, double log_v) {
  const double u = sign_of_u(region) * arctan_exp(log_u), v = sign_of_v(region) * arctan_exp(log_v);
  return {(u - v) / std::numbers::pi, (u + v) / std::numbers::pi};
}

}  // namespace

PenrosePoint penrose_point(Region region, double t, double r) {
  if (r == 2) return {};
  const double star = Schwarzschild::tortoise(r);
  return compactified(region, (star + t) / 4, (star - t) / 4);
}

PenrosePoint penrose_point(Region region, Tetrad tetrad, double r, double null_time) {
  // The reflection U <-> V takes region III to region I and t to -t.
  if (is_mirrored(tetrad)) {
    const Region reflected = region == Region::kIII ? Region::kI : region;
    const Tetrad own = is_outgoing(tetrad) ? Tetrad::kOutgoing : Tetrad::kRain;
    const PenrosePoint p = penrose_point(reflected, own, r, null_time);
    return {-p.x, p.up};
  }
  const double half_star = Schwarzschild::tortoise(r) / 2;  // ln|U V|
  if (is_outgoing(tetrad)) {
    const double log_v = -null_time / 4;
    return compactified(region, half_star - log_v, log_v);
  }
  const double log_u = null_time / 4;
  return compactified(region, log_u, half_star - log_u);
}

}  // namespace domefall
