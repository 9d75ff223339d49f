#include "pipeline/optics/hole_optics.h"

#include <cmath>
#include <numbers>

#include "pipeline/optics/exact_azimuth.h"
#include "pipeline/optics/silhouette.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Unit vector across R towards the source; any one if the source is on the axis.
V3d across(const V3d& source, double sine) {
  return sine > 0 ? V3d(0, source.y, source.z) / sine : V3d(0, 1, 0);
}

double frequency_ratio_of(const SkyTable& table, double r, double x) {
  const bool outer = table.delta_at(table.x_max()) > table.edge_angle();
  const double offset = 4 * std::atan(x / 2);
  const NullRay ray = outer ? ray_off_edge(r, Edge::kSilhouette, offset)
                            : ray_off_edge(r, Edge::kRegionThree, -offset);
  return 1 / one_plus_z(ray);
}

}  // namespace

HoleOptics make_hole_optics(Region region, double r, WantedSkies wanted) {
  HoleOptics optics{r, region, std::nullopt, std::nullopt};
  if (std::isinf(r)) return optics;
  if (wanted.one) optics.sky_one.emplace(r, Edge::kSilhouette);
  if (wanted.three && region == Region::kII && r < 2)
    optics.sky_three.emplace(r, Edge::kRegionThree);
  return optics;
}

SkyImage image_of(const HoleOptics& optics, const SkyTable* table, const V3d& source, int order,
                  double axis_blur) {
  if (table == nullptr) return {{source}, 1, 1};
  const double sine = std::hypot(source.y, source.z);
  const double phi_star = std::atan2(sine, source.x);
  const bool same_side = order % 2 == 0;
  const double phi = same_side ? phi_star + order * pi : (order + 1) * pi - phi_star;
  const double x = table->distance(phi);
  const double delta = table->delta_at(x);
  const double sin_delta = std::sin(delta);
  const V3d e = across(source, sine) * (same_side ? 1 : -1);
  SkyImage image;
  image.direction = {V3d(-std::cos(delta), 0, 0) + e * sin_delta};
  image.frequency_ratio = frequency_ratio_of(*table, optics.r, x);
  // At the far end, where sin(delta) and sin(phi) vanish together, their ratio is 1/slope.
  const double slope = table->slope(x);
  const double blurred = std::hypot(sine, axis_blur);
  const bool far_end = order == 0 && phi < 1e-6;
  image.amplification = far_end ? 1 / (slope * slope) : sin_delta / (blurred * slope);
  return image;
}

TetradDirection primary_image(double r, const V3d& source) {
  if (std::isinf(r)) return {source};
  const double sine = std::hypot(source.y, source.z);
  const double phi_star = std::atan2(sine, source.x);
  // phi falls from infinity at the edge to 0 at delta = pi.
  double low = 0, high = 2 * std::atan2(1.0, tan_half_silhouette(r));
  for (int step = 0; step < 200 && high - low > 1e-16; ++step) {
    const double middle = (low + high) / 2;
    const NullRay ray = ray_off_edge(r, Edge::kSilhouette, middle);
    (exact_azimuth(ray) > phi_star ? low : high) = middle;
  }
  const NullRay ray = ray_off_edge(r, Edge::kSilhouette, (low + high) / 2);
  const double delta = delta_of(ray);
  return {V3d(-std::cos(delta), 0, 0) + across(source, sine) * std::sin(delta)};
}

}  // namespace domefall
