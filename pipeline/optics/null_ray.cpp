#include "pipeline/optics/null_ray.h"

#include <cmath>

#include "pipeline/optics/silhouette.h"

namespace domefall {
namespace {

// The half-angle edge + offset/2 around an edge given by its half-angle tangent.
struct HalfAngle {
  double sine, cosine;
  double gap;  // sine - tangent * cosine, from the offset alone
};

HalfAngle turned(double tangent, double half_offset) {
  const double c = 1 / std::sqrt(1 + tangent * tangent), s = tangent * c;
  const double so = std::sin(half_offset), co = std::cos(half_offset);
  return {s * co + c * so, c * co - s * so, so / c};
}

// T_silhouette - T_region3 = 2 r / (sqrt 27 (1 + s)): the sum of the quadratic's roots.
double edge_separation(double r) { return 2 * r / (std::sqrt(27.0) * (1 + std::sqrt(2 / r))); }

}  // namespace

NullRay ray_at(const Radius& at, double delta) {
  NullRay ray = ray_off_edge(at, Edge::kSilhouette, delta - silhouette_edge(at));
  ray.sin_half = std::sin(delta / 2);
  ray.cos_half = delta < 3 ? std::cos(delta / 2) : std::sin((M_PI - delta) / 2);
  if (at.above_horizon <= 0) {
    const double half = (delta - region_three_edge(at)) / 2;
    ray.gap_three = std::sin(half) * std::hypot(1, tan_half_region_three(at));
  }
  return ray;
}

NullRay ray_off_edge(const Radius& at, Edge edge, double offset) {
  NullRay ray{at, 0, 0, 0, 0};
  const bool silhouette = edge == Edge::kSilhouette;
  const double tangent = silhouette ? tan_half_silhouette(at) : tan_half_region_three(at);
  const HalfAngle half = turned(tangent, offset / 2);
  // The far end of a sky (delta = pi or 0) is an end: rounding may not step over it.
  ray.sin_half = std::max(0.0, half.sine);
  ray.cos_half = std::max(0.0, half.cosine);
  const double apart = edge_separation(at.r) * ray.cos_half;
  ray.gap_silhouette = silhouette ? half.gap : half.gap - apart;
  ray.gap_three = silhouette ? half.gap + apart : half.gap;
  return ray;
}

double delta_of(const NullRay& ray) { return 2 * std::atan2(ray.sin_half, ray.cos_half); }

Origin origin_of(const NullRay& ray) {
  if (ray.gap_silhouette > 0) return Origin::kSkyOne;
  if (ray.at.above_horizon < 0 && ray.gap_three < 0) return Origin::kSkyThree;
  return Origin::kPastSingularity;
}

RayInvariants invariants(const NullRay& ray) {
  const double r = ray.at.r, sh = ray.sin_half, ch = ray.cos_half;
  const double s = std::sqrt(2 / r);
  const bool outside = ray.at.above_horizon > 0;
  const double inner = ray.at.above_horizon / (r * (1 + s));  // 1 - s
  const double silhouette = tan_half_silhouette(ray.at), other = tan_half_other_root(ray.at);
  // sh -+ other ch.  Outside, the first by way of the exact difference of the roots; inside,
  // other < 0 and the second is the gap to region III.
  const double root_difference =
      2 * ray.at.above_light_circle * std::sqrt(1 + 6 / r) / (std::sqrt(27.0) * (1 + s));
  const double beyond_other = outside ? ray.gap_silhouette - root_difference * ch : sh - other * ch;
  const double sum_other = outside ? sh + other * ch : ray.gap_three;
  RayInvariants k;
  k.below_critical = (1 + s) * ray.gap_silhouette * beyond_other;
  k.above_critical = (1 + s) * (sh + silhouette * ch) * sum_other;
  // Inside, where the direct form cancels, both factors have E's own sign.
  k.energy =
      outside ? (1 + s) * sh * sh + inner * ch * ch : (k.below_critical + k.above_critical) / 2;
  k.angular_momentum = 2 * r * sh * ch;
  k.radial = inner * ch * ch - (1 + s) * sh * sh;
  return k;
}

double one_plus_z(const NullRay& ray) { return std::abs(invariants(ray).energy); }

}  // namespace domefall
