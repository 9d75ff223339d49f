#include "pipeline/render/overlay/bent_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "pipeline/render/overlay/stroke.h"

namespace domefall {
namespace {

// Directions with a component along Z below this are too near to -Z, where projections stretch
// beyond use.
constexpr double kBehind = -0.9998;

// A PlaceOfPoint takes a point of a text to its place in the image, or to nothing if it has none.
using PlaceOfPoint = std::function<std::optional<ImagePoint>(const TextPoint&)>;

// An OutlineBender turns the curves of outlines into polygons in the image.
class OutlineBender {
 public:
  // In the image a straight line of the text bends by a radian over pixels_of_radian or more.
  OutlineBender(PlaceOfPoint place, double pixels_of_radian)
      : place_(std::move(place)), pixels_of_radian_(pixels_of_radian) {}

  // Calls use(polygon) for each outline that has an image.
  template <class Use>
  void each_polygon(const LetteredText& text, const Use& use) const {
    for (const TextOutline& outline : text.outlines)
      if (const auto polygon = bent(outline)) use(*polygon);
  }

 private:
  // Returns the outline as a polygon, or nothing if a point of it has no image.
  std::optional<ImagePolygon> bent(const TextOutline& outline) const {
    ImagePolygon polygon;
    if (!append(outline.start, polygon)) return std::nullopt;
    TextPoint from = outline.start;
    for (const TextCurve& curve : outline.curves) {
      if (!append_curve(from, curve, polygon)) return std::nullopt;
      from = curve.end;
    }
    return polygon;
  }

  bool append(const TextPoint& p, ImagePolygon& polygon) const {
    const auto place = place_(p);
    if (place) polygon.push_back(*place);
    return place.has_value();
  }

  // Appends a cubic Bezier curve in pieces.  An arc of length s that turns by the angle t departs
  // from its chord by s t/8, so a curve departs from n chords by length * angle/(8 n^2).  The
  // curves of letters turn by less than 2 radians.  The polygon of the control points bounds the
  // length.
  bool append_curve(const TextPoint& from, const TextCurve& curve, ImagePolygon& polygon) const {
    constexpr double kTolerance = 0.05, kLetterTurn = 2;  // pixels, radians
    constexpr double kMostPieces = 200;
    ImagePolygon corners{polygon.back()};
    for (const TextPoint& p : {curve.control1, curve.control2, curve.end})
      if (!append(p, corners)) return false;
    double pixels = 0;
    for (std::size_t k = 1; k < corners.size(); ++k)
      pixels += std::hypot(corners[k].x - corners[k - 1].x, corners[k].y - corners[k - 1].y);
    const double turn =
        std::min(kLetterTurn, (curve.straight ? 0 : kLetterTurn) + pixels / pixels_of_radian_);
    const int pieces = static_cast<int>(
        std::ceil(std::min(std::sqrt(pixels * turn / (8 * kTolerance)), kMostPieces)));
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces, u = 1 - t;
      const auto mixed = [&](double a, double b, double c, double d) {
        return u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d;
      };
      if (!append({mixed(from.x, curve.control1.x, curve.control2.x, curve.end.x),
                   mixed(from.y, curve.control1.y, curve.control2.y, curve.end.y)},
                  polygon))
        return false;
    }
    polygon.push_back(corners.back());
    return true;
  }

  PlaceOfPoint place_;
  double pixels_of_radian_;
};

// Returns the latitude of the text's middle about the pole of its lines.  It is the elevation up to
// 60 degrees.  From there on it falls twice as fast as the elevation rises, to 0 at the zenith.
double latitude_for(double elevation) {
  constexpr double kRight = std::numbers::pi / 2;
  const double above = std::min(std::abs(elevation), 2 * (kRight - std::abs(elevation)));
  return std::copysign(std::max(above, 0.0), elevation);
}

}  // namespace

void add_text(const LetteredText& text, const TextSurface& surface, const TextPoint& shift,
              const Projection& projection, Coverage& coverage) {
  const auto place = [&](const TextPoint& p) -> std::optional<ImagePoint> {
    const CameraDirection n = surface.direction({p.x + shift.x, p.y + shift.y});
    const bool seen = n.v.z > kBehind || traits_of(projection).has_seam;
    const auto pixel = seen ? pixel_of(projection, n) : std::nullopt;
    return pixel ? std::optional(image_point(*pixel)) : std::nullopt;
  };
  // Lines are taken to bend by a radian over an eighth of the larger side, which is four times as
  // fast as the rim of a dome.
  OutlineBender(place, std::max(columns(projection), rows(projection)) / 8.0)
      .each_polygon(
          text, [&](const ImagePolygon& polygon) { add_unwound(polygon, projection, coverage); });
}

void add_flat_text(const LetteredText& text, const ImagePoint& middle, double capital,
                   const ScreenSides& pixel, Coverage& coverage) {
  const auto place = [&](const TextPoint& p) -> std::optional<ImagePoint> {
    return ImagePoint{middle.x + capital * p.x / pixel.x, middle.y - capital * p.y / pixel.y};
  };
  // In a flat text straight lines do not bend.
  OutlineBender(place, HUGE_VAL).each_polygon(text, [&](const ImagePolygon& polygon) {
    coverage.add(polygon);
  });
}

TextSurface::TextSurface(const M33d& camera_from_audience, double azimuth, double elevation,
                         double height) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation),
               se = std::sin(elevation);
  const V3d middle(ce * sa, ce * ca, se), up(-se * sa, -se * ca, ce);
  const double latitude = latitude_for(elevation);
  const double cl = std::cos(latitude), sl = std::sin(latitude);
  right_ = apply(camera_from_audience, V3d(ca, -sa, 0));
  front_ = apply(camera_from_audience, middle * cl - up * sl);
  pole_ = apply(camera_from_audience, middle * sl + up * cl);
  // Mercator's ordinate of a latitude is asinh(tan(latitude)), and the sphere is cos(latitude)
  // times as large there as the map.
  scale_ = height / cl;
  start_ = std::asinh(std::tan(latitude));
}

TextSurface TextSurface::at(const M33d& camera_from_audience, const CameraDirection& n,
                            double height, double below) {
  const V3d seen = apply_transposed(camera_from_audience, n.v);
  return {camera_from_audience, std::atan2(seen.x, seen.y),
          std::asin(std::clamp(seen.z, -1.0, 1.0)) - below, height};
}

CameraDirection TextSurface::direction(const TextPoint& p) const {
  const double around = p.x * scale_, ordinate = start_ + p.y * scale_;
  // By the inverse of Mercator's projection, the cosine of the latitude is 1/cosh(ordinate) and the
  // sine is tanh(ordinate).
  const double across = 1 / std::cosh(ordinate);
  return {(front_ * std::cos(around) + right_ * std::sin(around)) * across +
          pole_ * std::tanh(ordinate)};
}

TextPoint TextSurface::point(const CameraDirection& n) const {
  // Beyond 1, by rounding, there is no ordinate.
  const double sine = std::clamp(n.v.dot(pole_), -1.0, 1.0);
  return {std::atan2(n.v.dot(right_), n.v.dot(front_)) / scale_,
          (std::atanh(sine) - start_) / scale_};
}

TextRegion::TextRegion(const TextSurface& surface, double half_width, double half_height)
    : front_(surface.front_),
      pole_(surface.pole_),
      least_sine_(std::tanh(surface.start_ - half_height * surface.scale_)),
      largest_sine_(std::tanh(surface.start_ + half_height * surface.scale_)),
      least_cosine_(std::cos(std::min(half_width * surface.scale_, std::numbers::pi))) {}

void add_outlines(Digest& digest, const LetteredText& text) {
  constexpr double kSteps = 1e5;
  // Adding 0 turns -0 into 0, so that both count as one number.
  const auto add = [&digest](const TextPoint& p) {
    digest.add(std::round(p.x * kSteps) + 0.0).add(std::round(p.y * kSteps) + 0.0);
  };
  for (const TextOutline& outline : text.outlines) {
    digest.add("outline");
    add(outline.start);
    for (const TextCurve& curve : outline.curves)
      for (const TextPoint& p : {curve.control1, curve.control2, curve.end}) add(p);
  }
}

}  // namespace domefall
