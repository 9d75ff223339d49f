#include "pipeline/light/schwarzschild_lens.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "pipeline/light/schwarzschild_points.h"
#include "pipeline/light/singularity_light.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {

SchwarzschildLens::SchwarzschildLens(std::shared_ptr<const HoleOptics> optics,
                                     const M33d& sky_from_tetrad)
    : optics_(std::move(optics)),
      sky_from_tetrad_(sky_from_tetrad),
      s_(Schwarzschild::free_fall_speed(optics_->at.r)),
      one_minus_s_(Schwarzschild::below_light_speed(optics_->at)),
      inward_(is_outgoing(optics_->tetrad) ? -1 : 1) {}

// Returns the circle of all directions at the angle alpha of null_ray.h.
ViewCircle SchwarzschildLens::circle_at(const HalfAngle& alpha) const {
  return {V3d(-inward_, 0, 0), (alpha.cosine - alpha.sine) * (alpha.cosine + alpha.sine),
          2 * alpha.sine * alpha.cosine};
}

std::vector<SkyBorder> SchwarzschildLens::borders() const {
  std::vector<SkyBorder> borders;
  for (const SkyRegion sky : optics_->skies())
    if (const SkyEdge* edge = optics_->edge_of(sky))
      borders.push_back({circle_at(edge->half), edge->sign < 0});
  return borders;
}

// The light of these rings has swept an azimuth of pi.
std::vector<ViewCurve> SchwarzschildLens::einstein_rings() const {
  std::vector<ViewCurve> rings;
  for (const SkyRegion sky : optics_->skies()) {
    const SkyTable* table = optics_->table_of(sky);
    if (table == nullptr) continue;
    const NullRay ray = table->ray_at_distance(table->distance(std::numbers::pi));
    rings.emplace_back(circle_at({ray.sin_half, ray.cos_half}));
  }
  return rings;
}

std::unique_ptr<const SkyPoints> SchwarzschildLens::points(
    SkyRegion sky, const std::optional<PointTolerance>& tolerance) const {
  const SkyTable* table = optics_->table_of(sky);
  return table ? std::make_unique<SchwarzschildPoints>(*table, tolerance) : nullptr;
}

V3d SchwarzschildLens::primary_image(const V3d& source) const {
  return domefall::primary_image(optics_->at.r, optics_->tetrad, source).v;
}

std::optional<BodyImage> SchwarzschildLens::body_image(double null_time, const BodyMotion& motion,
                                                       int order, double radius) const {
  return image_of_body({optics_->at, inward_ < 0, false}, null_time, motion, order, radius);
}

std::unique_ptr<const PlaneRays> SchwarzschildLens::plane(const PlaneRings& rings,
                                                          double null_time) const {
  return std::make_unique<PlaneRays>(optics_->at, optics_->tetrad, null_time, false, rings);
}

// The far ends of both skies lie on the axis, that of the tetrad's own sky outward and that of the
// other one inward.
std::optional<V3d> SchwarzschildLens::far_end(SkyRegion sky) const {
  if (!optics_->table_of(sky)) return std::nullopt;
  return V3d(sky == own_sky(optics_->tetrad) ? 1 : -1, 0, 0);
}

// The samples are evenly spaced in the ray's angle from the edge, which is 4 atan(x/2) for the
// table's coordinate x, and in the angle about the axis.
std::vector<SkySample> SchwarzschildLens::divided(SkyRegion sky, int along, int around) const {
  const SkyTable& table = *optics_->table_of(sky);
  const double d_alpha = 4 * std::atan(table.x_max() / 2) / along;
  const double d_psi = 2 * std::numbers::pi / around;
  std::vector<SkySample> samples;
  samples.reserve(static_cast<std::size_t>(along) * static_cast<std::size_t>(around));
  for (int i = 0; i < along; ++i) {
    const double x = 2 * std::tan((i + 0.5) * d_alpha / 4);
    const NullRay ray = table.ray_at_distance(x);
    // The double-angle formulas give the sine and cosine of alpha.
    const double sine = 2 * ray.sin_half * ray.cos_half;
    const double cosine = (ray.cos_half - ray.sin_half) * (ray.cos_half + ray.sin_half);
    const double phi = table.azimuth(x), slope = table.slope(x);
    SkySample sample;
    sample.frequency_ratio = 1 / one_plus_z(ray);
    sample.solid_angle = sine * d_alpha * d_psi;
    sample.footprint = std::max(slope * d_alpha, std::abs(std::sin(phi)) * d_psi);
    sample.bundle.patch = AxisPatch{2 * std::atan2(ray.sin_half, ray.cos_half), phi, slope};
    for (int j = 0; j < around; ++j) {
      const V3d e(0, std::cos((j + 0.5) * d_psi), std::sin((j + 0.5) * d_psi));
      sample.direction = V3d(-inward_ * cosine, 0, 0) + e * sine;
      sample.sky_direction = apply(sky_from_tetrad_, V3d(std::cos(phi), 0, 0) + e * std::sin(phi));
      samples.push_back(sample);
    }
  }
  return samples;
}

std::vector<V3d> SchwarzschildLens::special_directions() const {
  if (!optics_->white_hole) return {};
  return {V3d(1, 0, 0), V3d(-1, 0, 0)};
}

ViewRay SchwarzschildLens::ray(const V3d& d) const {
  ViewRay ray;
  const double sin_alpha = std::hypot(d.y, d.z);
  const HalfAngle half = half_angle(-inward_ * d.x, sin_alpha);
  const SkyTable* table = nullptr;
  double x = -1, side = 0;  // side: the sign of d phi/d(angle from +R)
  // A ray on a sky's side of its edge comes from that sky.  A ray that no sky has comes from the
  // past singularity.  An edge counts unless both of its sides are dark.
  for (const SkyRegion sky : optics_->skies()) {
    const SkyEdge* edge = optics_->edge_of(sky);
    if (edge == nullptr) continue;
    const SkyTable* its = optics_->table_of(sky);
    const double away = edge->distance(half.sine, half.cosine);
    if (its || optics_->white_hole) ray.to_edge = std::min(ray.to_edge, 2 * std::abs(away));
    if (!(away > 0) || ray.sky != SkyRegion::kIV) continue;
    ray.sky = sky;
    side = inward_ * edge->sign;  // phi falls from the edge on
    x = away;
    table = its;
  }
  double phi = 0, slope = 0;
  if (ray.sky == SkyRegion::kIV) {
    if (!optics_->white_hole) return ray;
    const WhiteHoleTable::Place place = optics_->white_hole->place_of(half.sine, half.cosine);
    phi = optics_->white_hole->azimuth(place);
    slope = bounded_slope(*optics_->white_hole, place);
    side = optics_->white_hole->slope(place) > 0 ? -inward_ : inward_;
    if (optics_->emission_times) {
      const auto value = emission_of(*optics_, half, phi, slope);
      ray.emission_time = value.time;
      ray.time_scale = value.slope;
    }
  } else {
    if (!table) return ray;
    phi = table->azimuth(x);
    slope = table->slope(x);
    ray.bundle.patch = AxisPatch{2 * std::atan2(half.sine, half.cosine), phi, slope};
    ray.swept = phi;
    // |E| = |1 - s cos(alpha)| is written by half of alpha, so that it does not cancel near r = 2.
    ray.frequency_ratio =
        1 / std::abs((1 + s_) * half.sine * half.sine + one_minus_s_ * half.cosine * half.cosine);
  }
  ray.known = true;
  // The light started at cos(phi) R + sin(phi) e, with e the part of d across R made a unit vector.
  const double sine = std::sin(phi), cosine = std::cos(phi);
  const double across = sin_alpha > 0 ? sine / sin_alpha : 0;
  ray.sky_direction = apply(sky_from_tetrad_, V3d(cosine, d.y * across, d.z * across));
  // As the angle from R grows, the direction moves along d.x e - sin(alpha) R.  As the plane of R
  // and e turns about R, direction and place move along R x e or against it.
  const V3d e = sin_alpha > 0 ? V3d(0, d.y, d.z) / sin_alpha : V3d(0, 1, 0);
  ray.axis = (e * d.x - V3d(sin_alpha, 0, 0)) * side;
  ray.along = apply(sky_from_tetrad_, e * cosine - V3d(sine, 0, 0));
  ray.scale_along = slope;
  ray.scale_across = std::abs(across);
  ray.mirrored = side * across < 0;
  return ray;
}

}  // namespace domefall
