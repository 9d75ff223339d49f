#include "pipeline/render/rays/sky_borders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace domefall {
namespace {

// A circle of a smaller radius, in pixels, is not resolved.
constexpr double kLeastRadius = 4;

// Returns the curve with what it encloses on its other side.
ViewCurve reversed(const ViewCurve& curve) {
  if (const auto* c = std::get_if<ViewCircle>(&curve))
    return ViewCircle{-c->axis, -c->cosine, c->sine};
  std::vector<V3d> corners = std::get<std::vector<V3d>>(curve);
  std::reverse(corners.begin(), corners.end());
  return corners;
}

BorderCurve border_curve(const ViewCurve& curve) {
  if (const auto* c = std::get_if<ViewCircle>(&curve)) return *c;
  return BorderPolygon(std::get<std::vector<V3d>>(curve));
}

// Returns how far a direction is beyond the border of a sky, at most.  The components of two
// directions along an axis differ by no more than the angle between them, and so do chords.
double beyond(const BorderCurve& curve, const V3d& n) {
  const auto* c = std::get_if<ViewCircle>(&curve);
  return c ? n.dot(c->axis) - c->cosine : std::get<BorderPolygon>(curve).chord_beyond(n);
}

// Returns the factor from that to an angle, next to the border.  A small step away from the axis of
// a circle changes the cosine by the sine times the step.
double angle_over_beyond(const BorderCurve& curve) {
  const auto* c = std::get_if<ViewCircle>(&curve);
  return c ? 1 / c->sine : 1;
}

// Returns the part of a pixel in the direction n that lies on the sky's side of its border.
double part_within(const BorderCurve& curve, const CameraDirection& n, double pixel_angle) {
  return std::clamp(0.5 - beyond(curve, n.v) * angle_over_beyond(curve) / pixel_angle, 0.0, 1.0);
}

// Returns the radius of a curve, or half of the largest distance of a polygon's corners from one.
double radius_of(const ViewCurve& curve) {
  if (const auto* c = std::get_if<ViewCircle>(&curve)) return c->sine;
  const auto& corners = std::get<std::vector<V3d>>(curve);
  double farthest = 0;
  for (const V3d& corner : corners) farthest = std::max(farthest, (corner - corners[0]).length());
  return farthest / 2;
}

}  // namespace

BorderPolygon::BorderPolygon(std::vector<V3d> corners) : corners_(std::move(corners)) {
  for (std::size_t first = 0; first < corners_.size(); first += kPart) {
    const std::size_t end = std::min(first + kPart, corners_.size());
    Part part{V3d(0, 0, 0), 0};
    for (std::size_t k = first; k <= end; ++k) part.middle += corner(k);
    part.middle /= static_cast<double>(end - first + 1);
    for (std::size_t k = first; k <= end; ++k)
      part.radius = std::max(part.radius, (corner(k) - part.middle).length());
    parts_.push_back(part);
  }
}

// The nearest part is looked at first, and of the others those that may have something nearer.
double BorderPolygon::chord_beyond(const V3d& n) const {
  double least = HUGE_VAL, side = 1;
  const auto look_at = [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kPart, corners_.size());
    for (std::size_t k = part * kPart; k < end; ++k) {
      const V3d &from = corner(k), way = corner(k + 1) - from;
      const V3d off = n - from - way * std::clamp((n - from).dot(way) / way.length2(), 0.0, 1.0);
      if (off.length2() >= least) continue;
      least = off.length2();
      side = from.cross(way).dot(n) < 0 ? -1 : 1;
    }
  };
  const auto distance = [&](const Part& part) { return (n - part.middle).length2(); };
  const auto nearest =
      std::min_element(parts_.begin(), parts_.end(),
                       [&](const Part& a, const Part& b) { return distance(a) < distance(b); });
  look_at(static_cast<std::size_t>(nearest - parts_.begin()));
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const double reach = parts_[k].radius + std::sqrt(least);
    if (parts_.begin() + static_cast<std::ptrdiff_t>(k) != nearest &&
        distance(parts_[k]) < reach * reach)
      look_at(k);
  }
  return side * std::sqrt(least);
}

std::optional<ViewCircle> BorderPolygon::around() const {
  V3d axis(0, 0, 0);
  for (const V3d& corner : corners_) axis += corner;
  axis.normalize();
  double cosine = 1;
  for (const V3d& corner : corners_) cosine = std::min(cosine, corner.dot(axis));
  if (!(cosine > 0) || chord_beyond(axis) < 0) return std::nullopt;
  return ViewCircle{axis, cosine, std::sqrt(1 - cosine * cosine)};
}

SkyBorders::SkyBorders(const ViewTracer& tracer, const Projection& projection) {
  const double least = kLeastRadius * largest_pixel_angle(projection);
  for (const SkyBorder& border : tracer.borders()) {
    curves_.push_back(border_curve(border.sky_within ? reversed(border.curve) : border.curve));
    skies_.push_back(border.sky);
    ends_.push_back(curves_.back());
    if (radius_of(border.curve) > least) continue;
    // The stars of a sky in a window of a few pixels end a little beyond it.
    const auto* window = border.sky_within ? std::get_if<ViewCircle>(&border.curve) : nullptr;
    if (window)
      ends_.back() = ViewCircle{-window->axis, -std::cos(2 * least), std::sin(2 * least)};
    else
      usable_ = false;
  }
  usable_ = usable_ && !curves_.empty();
  if (usable_) find_box(projection);
}

SkyBorders::Sight SkyBorders::sight_around(const CameraDirection& n, double reach) const {
  bool dark = true;
  for (const BorderCurve& curve : ends_) {
    const double off = beyond(curve, n.v);
    if (off < -reach) return Sight::kSky;
    dark = dark && off > reach;
  }
  return dark ? Sight::kNoSky : Sight::kBoth;
}

double SkyBorders::part_in_skies(const CameraDirection& n, double pixel_angle) const {
  double part = 0;
  for (const BorderCurve& curve : ends_) part += part_within(curve, n, pixel_angle);
  return std::min(part, 1.0);
}

// A sky without a border is all around, and one with two lies beyond both.
PerSky<double> SkyBorders::parts(const CameraDirection& n, double pixel_angle,
                                 const PerSky<bool>& seen) const {
  PerSky<double> parts;
  for (const SkyRegion sky : kExteriorSkies) parts[sky] = curves_.empty() && seen[sky] ? 1 : 0;
  for (std::size_t k = 0; k < curves_.size(); ++k)
    parts[skies_[k]] += part_within(curves_[k], n, pixel_angle);
  return parts;
}

// All pixels without a sky lie inside the first curve, where the first sky ends.  If a circle around it
// encloses less than a hemisphere, the image of its rim bounds them.
void SkyBorders::find_box(const Projection& projection) {
  constexpr int kPlaces = 96, kMargin = 3;
  const int width = columns(projection), height = rows(projection);
  box_ = PixelBox{0, width - 1, 0, height - 1};
  // On an image of the whole sphere that is no dome, a rim that crosses its edge, or goes around a
  // pole, is no closed curve.
  if (has_zenith(projection) && !traits_of(projection).is_dome) return;
  const auto* circle = std::get_if<ViewCircle>(&ends_.front());
  const std::optional<ViewCircle> around =
      circle ? *circle : std::get<BorderPolygon>(ends_.front()).around();
  if (!around) return;
  const ViewCircle& c = *around;
  // If the rim goes around -Z, the one direction without an image, what the rim encloses lies
  // outside its image.
  if (c.cosine < 0 || -c.axis.z > c.cosine - 0.05) return;
  const V3d e1 = c.axis.cross(std::abs(c.axis.z) < 0.7 ? V3d(0, 0, 1) : V3d(1, 0, 0)).normalized();
  const V3d e2 = c.axis.cross(e1);
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  for (int k = 0; k < kPlaces; ++k) {
    const double t = 2 * std::numbers::pi * k / kPlaces;
    const auto pixel =
        pixel_of(projection, {c.axis * c.cosine + (e1 * std::cos(t) + e2 * std::sin(t)) * c.sine});
    if (!pixel) return;
    left = std::min(left, pixel->i - 1), right = std::max(right, pixel->i - 1);
    top = std::min(top, pixel->j - 1), bottom = std::max(bottom, pixel->j - 1);
  }
  // Between two of the places the rim bulges by 1 - cos(pi/kPlaces) of its radius, which is less
  // than a thousandth.
  const double margin = kMargin + 1e-3 * (right - left + bottom - top);
  const auto within = [](double v, int last) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(last)));
  };
  if (right + margin < 0 || bottom + margin < 0 || left - margin > width - 1 ||
      top - margin > height - 1) {
    box_.reset();
    return;
  }
  box_ = PixelBox{within(left - margin, width - 1), within(right + margin, width - 1),
                  within(top - margin, height - 1), within(bottom + margin, height - 1)};
}

}  // namespace domefall
