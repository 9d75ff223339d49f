#include "pipeline/render/overlay/frame_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/stroke.h"
#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

constexpr double kDegrees2Radians = std::numbers::pi / 180;

// Marks collect lines of one width, and draw them in one colour.
class Marks {
 public:
  Marks(const FrameState& state, const FrameRef& frame)
      : state_(state),
        projection_(state.projection),
        width_(mark_width(projection_)),
        pixel_(screen_sides(projection_)),
        coverage_(frame.width, frame.height) {}

  const Projection& projection() const { return projection_; }
  bool dome() const { return traits_of(projection_).is_dome; }

  void curve(const ViewCurve& curve) { add_curve(curve, width_, projection_, coverage_); }

  // Adds a box in the middle of the image that has this part of its width and height.
  void box(double part) {
    const double w = columns(projection_), h = rows(projection_);
    // The band lies within the image.
    const double x = std::max(w * (1 - part) / 2, width_ / pixel_.x / 2),
                 y = std::max(h * (1 - part) / 2, width_ / pixel_.y / 2);
    add_stroke({{x, y}, {w - x, y}, {w - x, h - y}, {x, h - y}}, true, width_, pixel_, coverage_);
  }

  // A Place is a direction as the audience sees it, in degrees.
  struct Place {
    double azimuth, elevation;
  };
  // Adds the line from one place to another along which both angles change evenly.
  void way(const Place& from, const Place& to, double width_part = 1) {
    add_curve(
        [&](double part) {
          const double a = std::lerp(from.azimuth, to.azimuth, part) * kDegrees2Radians,
                       e = std::lerp(from.elevation, to.elevation, part) * kDegrees2Radians;
          return apply(state_.camera_from_audience,
                       V3d(std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)));
        },
        false, width_ * width_part, projection_, coverage_);
  }

  // Adds the border of the field in front that reaches so far to either side, in degrees.
  void field(double aside, double lowest, double highest) {
    way({-aside, lowest}, {aside, lowest});
    way({aside, lowest}, {aside, highest});
    way({aside, highest}, {-aside, highest});
    way({-aside, highest}, {-aside, lowest});
  }

  // Adds the circle about the middle of a dome's image at this angle, or at this distance on the
  // screen from its edge.
  void circle(double angle) { curve(ViewCircle{V3d(0, 0, 1), std::cos(angle), std::sin(angle)}); }
  void circle_within(double distance) {
    const PixelPosition middle = origin_of(projection_);
    const CameraDirection n = direction_at(
        projection_, {middle.i + columns(projection_) / 2.0 - distance / pixel_.x, middle.j});
    curve(ViewCircle{V3d(0, 0, 1), n.v.z, n.v.x});
  }

  void draw(const WorkingRgb& light, double opacity, const FrameRef& frame) const {
    draw_over(coverage_, {light, opacity}, projection_, frame);
  }
  double width() const { return width_; }

 private:
  const FrameState& state_;
  const Projection& projection_;
  double width_;
  ScreenSides pixel_;
  Coverage coverage_;
};

// Adds circles of elevation and meridians.  Only the meridians to the front, the back and the sides
// reach the poles, so that lines do not crowd there.
void add_grid(Marks& marks) {
  constexpr int kElevations = 15, kAzimuths = 30, kUpTo = 75, kRight = 90;
  for (int elevation = -kUpTo; elevation <= kUpTo; elevation += kElevations)
    for (int azimuth = 0; azimuth < 360; azimuth += kRight)
      marks.way({double(azimuth), double(elevation)}, {double(azimuth + kRight), double(elevation)},
                0.5);
  for (int azimuth = 0; azimuth < 360; azimuth += kAzimuths) {
    const double end = azimuth % kRight == 0 ? kRight : kUpTo;
    marks.way({double(azimuth), -end}, {double(azimuth), end}, 0.5);
  }
}

void add_safe_area(Marks& marks) {
  if (has_zenith(marks.projection()))
    marks.field(kSafeAzimuthDeg, kSafeElevationDeg, kSafeHighestDeg);
  if (marks.dome())
    return marks.circle(farthest_angle(marks.projection()) - kSafeElevationDeg * kDegrees2Radians);
  marks.box(kSafeAction);
  marks.box(kSafeTitles);
}

void add_sweet_spot(Marks& marks) {
  if (!has_zenith(marks.projection())) return marks.box(kMiddleThird);
  marks.field(kSweetAzimuthDeg, kSweetLowestDeg, kSweetHighestDeg);
}

// The colours of overlays (Rec.709), which are distinct also for most people who see fewer colours.
constexpr std::pair<OverlayKind, std::array<double, 3>> kOverlayLights[]{
    {OverlayKind::kGrid, {0.15, 0.2, 0.3}},     {OverlayKind::kRim, {1, 1, 1}},
    {OverlayKind::kSafeArea, {0.1, 1, 0.2}},    {OverlayKind::kSweetSpot, {1, 0.8, 0.1}},
    {OverlayKind::kSilhouette, {1, 0.15, 0.1}}, {OverlayKind::kEinsteinRing, {0.1, 0.6, 1}},
    {OverlayKind::kErgosphere, {1, 0.4, 0.8}}};

WorkingRgb light_of(OverlayKind overlay) {
  for (const auto& [kind, rgb] : kOverlayLights) {
    if (kind != overlay) continue;
    const V3d light = apply(working_from_rec709(), V3d(rgb[0], rgb[1], rgb[2]));
    return {static_cast<float>(light.x), static_cast<float>(light.y), static_cast<float>(light.z)};
  }
  return {1, 1, 1};
}

// Draws the silhouette, the Einstein rings or the ergosphere.  Without lensing there are none.
void draw_curves(OverlayKind overlay, const Show& show, const FrameState& state, double opacity,
                 const FrameRef& frame) {
  if (!show.effects.lensing) return;
  const bool rings = overlay == OverlayKind::kEinsteinRing;
  const ViewTracer tracer(state, WantedSkies{{rings, rings, false, rings}}, show.effects);
  Marks marks(state, frame);
  if (rings)
    for (const ViewCurve& ring : tracer.einstein_rings()) marks.curve(ring);
  if (overlay == OverlayKind::kErgosphere)
    if (const auto outline = tracer.ergosphere()) marks.curve(*outline);
  if (overlay == OverlayKind::kSilhouette)
    for (const SkyBorder& border : tracer.borders()) marks.curve(border.curve);
  marks.draw(light_of(overlay), opacity, frame);
}

}  // namespace

double mark_width(const Projection& projection) {
  constexpr double kOfTheSmallerSide = 1. / 700;
  return std::max(1.0, kOfTheSmallerSide * shorter_side(projection));
}

void draw_marks(OverlayKind overlay, const Show& show, const FrameState& state,
                const FrameRef& frame) {
  if (overlay == OverlayKind::kSilhouette || overlay == OverlayKind::kEinsteinRing ||
      overlay == OverlayKind::kErgosphere) {
    draw_curves(overlay, show, state, 1 - state.vanishing_part, frame);
    if (state.vanishing) draw_curves(overlay, show, *state.vanishing, state.vanishing_part, frame);
    return;
  }
  Marks marks(state, frame);
  if (overlay == OverlayKind::kGrid) add_grid(marks);
  if (overlay == OverlayKind::kSafeArea) add_safe_area(marks);
  if (overlay == OverlayKind::kSweetSpot) add_sweet_spot(marks);
  if (overlay == OverlayKind::kRim)
    marks.dome() ? marks.circle_within(marks.width() / 2) : marks.box(1);
  marks.draw(light_of(overlay), 1, frame);
}

}  // namespace domefall
