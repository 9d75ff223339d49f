#include "pipeline/render/rays/sky_borders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

// A circle of a smaller radius, in pixels, is not resolved.
constexpr double kLeastRadius = 4;

}  // namespace

SkyBorders::SkyBorders(const FrameState& state, const HoleOptics& optics, const Vantage& vantage) {
  for (const SkyRegion sky : optics.skies()) {
    const SkyEdge* edge = optics.edge_of(sky);
    if (edge == nullptr) continue;
    const ViewCircle c = view_circle(edge->half, state.observer, vantage.celerity);
    // If the sky lies at smaller alpha, the reversed axis and cosine describe the same circle with
    // the sky where n.axis < cosine.
    const double sign = edge->sign;
    circles_.push_back({c.axis * sign, sign * c.cosine, c.sine});
    usable_ = usable_ && c.sine > kLeastRadius * central_pixel_angle(state.projection);
  }
  usable_ = usable_ && !circles_.empty();
  if (usable_) find_box(state.projection);
}

// The components of two directions along an axis differ by no more than the angle between them.
SkyBorders::Sight SkyBorders::sight_around(const CameraDirection& n, double reach) const {
  bool dark = true;
  for (const ViewCircle& c : circles_) {
    const double beyond = n.v.dot(c.axis) - c.cosine;
    if (beyond < -reach) return Sight::kSky;
    dark = dark && beyond > reach;
  }
  return dark ? Sight::kNoSky : Sight::kBoth;
}

double SkyBorders::part_in_skies(const CameraDirection& n, double pixel_angle) const {
  // A small step away from the axis changes the cosine by the sine times the step, so `beyond` is
  // the distance of the pixel's middle from the border, in pixels.
  double part = 0;
  for (const ViewCircle& c : circles_) {
    const double beyond = (n.v.dot(c.axis) - c.cosine) / (c.sine * pixel_angle);
    part += std::clamp(0.5 - beyond, 0.0, 1.0);
  }
  return std::min(part, 1.0);
}

// All pixels without a sky lie inside the first circle, where the first sky ends.  If the circle
// encloses less than a hemisphere, the image of its rim bounds them.
void SkyBorders::find_box(const Projection& projection) {
  constexpr int kPlaces = 96, kMargin = 3;
  const int width = columns(projection), height = rows(projection);
  box_ = PixelBox{0, width - 1, 0, height - 1};
  // A rim that crosses the seam of a whole sphere, or goes around a pole, is no closed curve in the
  // image.
  if (std::holds_alternative<Equirectangular>(projection)) return;
  const ViewCircle& c = circles_.front();
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
