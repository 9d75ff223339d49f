#include "pipeline/render/overlay/seam.h"

#include <cmath>

namespace domefall {

void unwind(const Projection& projection, std::vector<ImagePoint>& points) {
  if (!std::holds_alternative<Equirectangular>(projection)) return;
  const double width = columns(projection);
  for (std::size_t k = 1; k < points.size(); ++k)
    points[k].x -= width * std::round((points[k].x - points[k - 1].x) / width);
}

double winding(const Projection& projection, const std::vector<ImagePoint>& points) {
  if (points.empty() || !std::holds_alternative<Equirectangular>(projection)) return 0;
  const double width = columns(projection);
  return width * std::round((points.back().x - points.front().x) / width);
}

void add_unwound(ImagePolygon polygon, const Projection& projection, Coverage& coverage) {
  unwind(projection, polygon);
  if (winding(projection, polygon) != 0) {
    double sum = 0;
    for (const ImagePoint& p : polygon) sum += p.y;
    const double height = rows(projection);
    const double pole = sum < height / 2 * static_cast<double>(polygon.size()) ? 0 : height;
    // The line goes on to its first point a whole width away, from there to the edge of the image
    // at the pole, and back along the edge.
    const ImagePoint first = polygon.front();
    const double end = first.x + winding(projection, polygon);
    polygon.insert(polygon.end(), {{end, first.y}, {end, pole}, {first.x, pole}});
  }
  each_copy(projection, [&](double shift) {
    ImagePolygon copy = polygon;
    for (ImagePoint& p : copy) p.x += shift;
    coverage.add(copy);
  });
}

}  // namespace domefall
