#include "pipeline/render/overlay/bent_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace domefall {
namespace {

// Nearer to -Z than this a projection stretches beyond use.
constexpr double kBehind = -0.9998;

class OutlineBender {
 public:
  OutlineBender(const TextSurface& surface, const Projection& projection)
      : surface_(surface), projection_(projection) {}

  // Nothing if it has no image.
  std::optional<PicturePolygon> bent(const TextOutline& outline) {
    PicturePolygon polygon;
    if (!append(outline.start, polygon)) return std::nullopt;
    TextPoint from = outline.start;
    for (const TextCurve& curve : outline.curves) {
      if (!append_curve(from, curve, polygon)) return std::nullopt;
      from = curve.end;
    }
    return polygon;
  }

 private:
  bool append(const TextPoint& p, PicturePolygon& polygon) const {
    const CameraDirection n = surface_.direction(p);
    const auto pixel = n.v.z > kBehind ? pixel_of(projection_, n) : std::nullopt;
    if (pixel) polygon.push_back(picture_point(*pixel));
    return pixel.has_value();
  }

  // A curve that turns by a radian departs from n chords by its length/(8 n^2).  A straight line is
  // bent by the sphere alone.
  bool append_curve(const TextPoint& from, const TextCurve& curve, PicturePolygon& polygon) const {
    constexpr double kTolerance = 0.05;  // pixels
    PicturePolygon corners{polygon.back()};
    for (const TextPoint& p : {curve.control1, curve.control2, curve.end})
      if (!append(p, corners)) return false;
    double pixels = 0;
    for (std::size_t k = 1; k < corners.size(); ++k)
      pixels += std::hypot(corners[k].x - corners[k - 1].x, corners[k].y - corners[k - 1].y);
    const double most = std::hypot(columns(projection_), rows(projection_));
    const double turn = curve.straight ? std::min(1.0, 8 * pixels / most) : 2;
    const int pieces = static_cast<int>(
        std::ceil(std::sqrt(std::min(pixels, 4 * most) * turn / (8 * kTolerance))));
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

  const TextSurface& surface_;
  const Projection& projection_;
};

}  // namespace

void add_text(const LetteredText& text, const TextSurface& surface, const Projection& projection,
              Coverage& coverage) {
  OutlineBender bender(surface, projection);
  for (const TextOutline& outline : text.outlines)
    if (const auto polygon = bender.bent(outline)) coverage.add(*polygon);
}

}  // namespace domefall
