#include "pipeline/spacetime/conformal.h"

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

constexpr double kScale = 4;  // M, or radii of a throat

double compactified(double x, double kappa) {
  const double stretched = kappa > 0 ? std::sinh(kappa * x) / (kScale * kappa) : x / kScale;
  return std::atan(stretched) / std::numbers::pi;
}

double surface_gravity(const ChargedHole& hole) {
  const double outer = hole.horizon();
  return hole.is_naked() ? 0 : (outer - hole.inner_horizon()) / (2 * outer * outer);
}

PenrosePoint point_at_times(const ChargedHole& hole, Region region, int universe, double v,
                            double u) {
  const double kappa = surface_gravity(hole);
  double p = compactified(v, kappa), q = compactified(u, kappa);
  if (region == Region::kII) q = 1 - q;
  if (region == Region::kIV) p = -1 - p;
  if (region == Region::kV) q += universe_height(hole);
  const double axis = hole.is_naked() ? 0 : 0.5;
  return {(p - q) / 2 + axis, (p + q) / 2 + universe * universe_height(hole)};
}

}  // namespace

double universe_height(const ChargedHole& hole) { return hole.is_extremal() ? 1 : 2; }

PenrosePoint penrose_point(const ChargedHole& hole, Region region, int universe, double t,
                           double r) {
  const double star = hole.tortoise(r);
  return point_at_times(hole, region, universe, t + star, t - star);
}

PenrosePoint penrose_point(const ChargedHole& hole, Region region, int universe, Tetrad tetrad,
                           double r, double null_time) {
  const double twice_star = 2 * hole.tortoise(r);
  const Region own = is_mirrored(tetrad) ? mirror_of(region) : region;
  const PenrosePoint p =
      is_outgoing(tetrad) ? point_at_times(hole, own, universe, null_time + twice_star, null_time)
                          : point_at_times(hole, own, universe, null_time, null_time - twice_star);
  return is_mirrored(tetrad) ? PenrosePoint{-p.x, p.up} : p;
}

PenrosePoint penrose_point(const Wormhole&, double t, double l) {
  const double p = compactified(t + l, 0), q = compactified(t - l, 0);
  return {p - q, p + q};
}

}  // namespace domefall
