#include "pipeline/light/spherical_lens.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "pipeline/light/singularity_light.h"
#include "pipeline/light/spherical_points.h"

namespace domefall {
namespace {

bool is_from_core(const SkyZone& zone) { return zone.end && zone.end->core; }

}  // namespace

SphericalLens::SphericalLens(std::shared_ptr<const HoleOptics> optics, const PerSky<M33d>& axes)
    : optics_(std::move(optics)),
      axes_(axes),
      far_mirrored_(axes[SkyRegion::kIII] != axes[SkyRegion::kI]) {}

// Returns the circle of all directions at the angle alpha of SkyZone.
ViewCircle SphericalLens::circle_at(const HalfAngle& alpha) const {
  return {V3d(-optics_->inward, 0, 0), (alpha.cosine - alpha.sine) * (alpha.cosine + alpha.sine),
          2 * alpha.sine * alpha.cosine};
}

// A sky that lies on both sides of one edge does not end there.
std::vector<SkyBorder> SphericalLens::borders() const {
  std::vector<SkyBorder> borders;
  const std::vector<SkyPart>& parts = optics_->parts;
  const auto same_edge = [](const SkyEdge& a, const SkyEdge& b) {
    return a.half.sine == b.half.sine && a.half.cosine == b.half.cosine;
  };
  if (parts.size() == 2 && parts[0].sky == parts[1].sky &&
      same_edge(parts[0].zone.edge, parts[1].zone.edge))
    return borders;
  for (const SkyPart& part : parts)
    borders.push_back({circle_at(part.zone.edge.half), part.zone.edge.sign < 0, part.sky});
  return borders;
}

// The light of these rings has swept an azimuth of pi.
std::vector<ViewCurve> SphericalLens::einstein_rings() const {
  std::vector<ViewCurve> rings;
  for (const SkyPart& part : optics_->parts)
    if (part.table && part.table->most_azimuth() > std::numbers::pi)
      rings.emplace_back(
          circle_at(part.table->ray_at_distance(part.table->distance(std::numbers::pi)).half));
  return rings;
}

std::unique_ptr<const SkyPoints> SphericalLens::points(
    SkyRegion sky, const std::optional<PointTolerance>& tolerance) const {
  auto tables = optics_->tables_of(sky);
  return tables.empty() ? nullptr : std::make_unique<SphericalPoints>(std::move(tables), tolerance);
}

V3d SphericalLens::primary_image(const V3d& source) const {
  return domefall::primary_image(*optics_, source).v;
}

// The far end of a zone lies on the axis.  There light from the core is spread without bound however
// large the zone is, so that its middle stands for it.
std::vector<V3d> SphericalLens::far_ends(SkyRegion sky) const {
  std::vector<V3d> ends;
  for (const SkyPart& part : optics_->parts) {
    if (part.sky != sky || !part.table) continue;
    const double off = is_from_core(part.zone) ? part.zone.reach / 2 : 0;
    ends.emplace_back(part.zone.edge.sign * optics_->inward * std::cos(off), std::sin(off), 0);
  }
  return ends;
}

// The samples are evenly spaced in the ray's angle from the edge, which is 4 atan(x/2) for the
// table's coordinate x, and in the angle about the axis.
std::vector<SkySample> SphericalLens::divided(SkyRegion sky, int along, int around) const {
  std::vector<SkySample> samples;
  for (const SkyTable* table : optics_->tables_of(sky))
    divide(*table, axes_[sky], along, around, samples);
  return samples;
}

void SphericalLens::divide(const SkyTable& table, const M33d& axes, int along, int around,
                           std::vector<SkySample>& samples) const {
  const double d_alpha = 4 * std::atan(table.x_max() / 2) / along;
  const double d_psi = 2 * std::numbers::pi / around;
  samples.reserve(samples.size() +
                  static_cast<std::size_t>(along) * static_cast<std::size_t>(around));
  for (int i = 0; i < along; ++i) {
    const double x = 2 * std::tan((i + 0.5) * d_alpha / 4);
    const ZoneRay ray = table.ray_at_distance(x);
    const double sine = ray.sine(), cosine = ray.cosine();
    const double phi = table.azimuth(x), slope = table.slope(x);
    SkySample sample;
    sample.frequency_ratio = 1 / ray.one_plus_z;
    sample.solid_angle = sine * d_alpha * d_psi;
    sample.footprint = std::max(slope * d_alpha, std::abs(std::sin(phi)) * d_psi);
    sample.bundle.patch = AxisPatch{ray.half.angle(), phi, slope};
    for (int j = 0; j < around; ++j) {
      const V3d e(0, std::cos((j + 0.5) * d_psi), std::sin((j + 0.5) * d_psi));
      sample.direction = V3d(-optics_->inward * cosine, 0, 0) + e * sine;
      sample.sky_direction = apply(axes, V3d(std::cos(phi), 0, 0) + e * std::sin(phi));
      samples.push_back(sample);
    }
  }
}

std::vector<V3d> SphericalLens::special_directions() const {
  std::vector<V3d> special;
  if (optics_->white_hole) special = {V3d(1, 0, 0), V3d(-1, 0, 0)};
  for (const SkyPart& part : optics_->parts)
    if (part.table && is_from_core(part.zone))
      special.emplace_back(part.zone.edge.sign * optics_->inward, 0, 0);
  return special;
}

ViewRay SphericalLens::ray(const V3d& d) const {
  ViewRay ray;
  ray.sky_direction = V3d(0, 0, 0);
  const double sin_alpha = std::hypot(d.y, d.z);
  const double inward = optics_->inward;
  const HalfAngle half = half_angle(-inward * d.x, sin_alpha);
  const SkyTable* table = nullptr;
  double x = -1, side = 0;  // side: the sign of d phi/d(angle from +R)
  // A ray on a sky's side of its edge comes from that sky.  A ray that no sky has comes from the
  // past singularity.  An edge counts unless both of its sides are dark.
  for (const SkyPart& part : optics_->parts) {
    const SkyEdge& edge = part.zone.edge;
    const double away = edge.distance(half.sine, half.cosine);
    if (part.table || optics_->white_hole)
      ray.to_edge = std::min(ray.to_edge, std::max(2 * std::abs(away), edge.width));
    if (!(away > 0) || ray.sky != SkyRegion::kIV) continue;
    ray.sky = part.sky;
    side = inward * part.zone.edge.sign;  // phi falls from the edge on
    x = away;
    table = part.table ? &*part.table : nullptr;
  }
  double phi = 0, slope = 0;
  if (ray.sky == SkyRegion::kIV) {
    if (!optics_->white_hole) return ray;
    const WhiteHoleTable::Place place = optics_->white_hole->place_of(half.sine, half.cosine);
    phi = optics_->white_hole->azimuth(place);
    slope = bounded_slope(*optics_->white_hole, place);
    side = optics_->white_hole->slope(place) > 0 ? -inward : inward;
    if (optics_->emission_times) {
      const auto value = emission_of(*optics_, half, phi, slope);
      ray.emission_time = value.time;
      ray.time_scale = value.slope;
    }
  } else {
    if (!table) return ray;
    phi = table->azimuth(x);
    slope = table->slope(x);
    ray.bundle.patch = AxisPatch{half.angle(), phi, slope};
    ray.swept = phi;
    const ViewEnergy& energy = optics_->energy;
    ray.frequency_ratio = 1 / energy.one_plus_z(energy.sine2 * half.sine * half.sine +
                                                energy.cosine2 * half.cosine * half.cosine);
  }
  ray.known = true;
  // The light started at cos(phi) R + sin(phi) e, with e the part of d across R made a unit vector.
  const double sine = std::sin(phi), cosine = std::cos(phi);
  const double across = sin_alpha > 0 ? sine / sin_alpha : 0;
  ray.sky_direction = apply(axes_[ray.sky], V3d(cosine, d.y * across, d.z * across));
  // As the angle from R grows, the direction moves along d.x e - sin(alpha) R.  As the plane of R
  // and e turns about R, direction and place move along R x e or against it.
  const V3d e = sin_alpha > 0 ? V3d(0, d.y, d.z) / sin_alpha : V3d(0, 1, 0);
  ray.axis = (e * d.x - V3d(sin_alpha, 0, 0)) * side;
  ray.along = apply(axes_[ray.sky], e * cosine - V3d(sine, 0, 0));
  ray.scale_along = slope;
  ray.scale_across = std::abs(across);
  ray.mirrored = (side * across < 0) != (far_mirrored_ && ray.sky == SkyRegion::kIII);
  return ray;
}

}  // namespace domefall
