#include "pipeline/render/overlay/stroke.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

// A curve is cut where its component along Z is below this.  Such directions near -Z are outside
// any image except a flat one of more than 340 degrees.
constexpr double kStrokeBehind = -0.99;

// Returns the unit normal of a piece of line on the screen, or 0 if the piece has no length.
ImagePoint unit_across(const ImagePoint& from, const ImagePoint& to, const ScreenSides& pixel) {
  const double x = (to.x - from.x) * pixel.x, y = (to.y - from.y) * pixel.y,
               length = std::hypot(x, y);
  return length > 0 ? ImagePoint{-y / length, x / length} : ImagePoint{0, 0};
}

// Returns the vector from a corner to the edge of the band.  It points along the sum of the normals
// a and b on both sides of the corner.
ImagePoint offset_between(const ImagePoint& a, const ImagePoint& b, double half) {
  const double x = a.x + b.x, y = a.y + b.y;
  // For unit normals at an angle t, |a + b| = 2 cos(t/2), and a mitre is half/cos(t/2) long.  So
  // the mitre is 2 half (a + b)/|a + b|^2.  From t = 120 degrees on it is limited, because a sharp
  // corner would have a long spike.
  const double scale = half * 2 / std::max(x * x + y * y, 1.0);
  return {x * scale, y * scale};
}

// Adds a line of points that were placed one by one.
void add_run(std::vector<ImagePoint> run, bool closed, double width, const Projection& projection,
             Coverage& coverage) {
  unwind(projection, run);
  // A closed line around a pole ends where it began, but a width farther on in the image.
  if (const double around = closed ? winding(projection, run) : 0; around != 0) {
    run.push_back({run.front().x + around, run.front().y});
    closed = false;
  }
  each_copy(projection, [&](double shift) {
    std::vector<ImagePoint> copy = run;
    for (ImagePoint& p : copy) p.x += shift;
    add_stroke(copy, closed, width, screen_sides(projection), coverage);
  });
}

}  // namespace

// The outline of the band goes along the line on one side and back on the other.  Both ends of a
// closed band meet in a seam of no width.
void add_stroke(const std::vector<ImagePoint>& line, bool closed, double width,
                const ScreenSides& pixel, Coverage& coverage) {
  std::vector<ImagePoint> points;  // without repeated points, between which there is no direction
  for (const ImagePoint& p : line)
    if (points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) > 1e-6)
      points.push_back(p);
  if (points.size() < 2) return;
  const std::size_t count = points.size(), last = closed ? count : count - 1;
  const auto normal = [&](std::size_t k) {  // of the piece that begins at point k
    return unit_across(points[k % count], points[(k + 1) % count], pixel);
  };
  ImagePolygon there, back;
  for (std::size_t k = 0; k <= last; ++k) {
    const ImagePoint before = k > 0 ? normal(k - 1) : normal(closed ? count - 1 : 0);
    const ImagePoint after = k < last || closed ? normal(k) : before;
    const ImagePoint offset = offset_between(before, after, width / 2), &p = points[k % count];
    there.push_back({p.x + offset.x / pixel.x, p.y + offset.y / pixel.y});
    back.push_back({p.x - offset.x / pixel.x, p.y - offset.y / pixel.y});
  }
  there.insert(there.end(), back.rbegin(), back.rend());
  coverage.add(there);
}

void add_curve(const std::function<V3d(double)>& direction, bool closed, double width,
               const Projection& projection, Coverage& coverage) {
  const int pieces =
      64 + static_cast<int>(8 * std::sqrt(std::max(columns(projection), rows(projection))));
  // A run is a piece of the curve all of which has an image.
  std::vector<ImagePoint> run;
  bool whole = true;
  for (int k = 0; k < pieces + (closed ? 0 : 1); ++k) {
    const CameraDirection n{direction(static_cast<double>(k) / pieces)};
    const bool seen = n.v.z > kStrokeBehind || traits_of(projection).has_seam;
    const auto pixel = seen ? pixel_of(projection, n) : std::nullopt;
    if (pixel) {
      run.push_back(image_point(*pixel));
      continue;
    }
    whole = false;
    add_run(run, false, width, projection, coverage);
    run.clear();
  }
  add_run(run, closed && whole, width, projection, coverage);
}

void add_curve(const ViewCurve& curve, double width, const Projection& projection,
               Coverage& coverage) {
  if (const auto* corners = std::get_if<std::vector<V3d>>(&curve)) {
    const auto corner = [&](double part) {
      const double at = part * static_cast<double>(corners->size()), whole = std::floor(at);
      const auto k = static_cast<std::size_t>(whole) % corners->size();
      return (*corners)[k] + ((*corners)[(k + 1) % corners->size()] - (*corners)[k]) * (at - whole);
    };
    add_curve([&](double part) { return corner(part).normalized(); }, true, width, projection,
              coverage);
    return;
  }
  const auto& circle = std::get<ViewCircle>(curve);
  // e1 and e2 are unit vectors at right angles to the axis and to each other.
  const V3d e1 =
      circle.axis.cross(std::abs(circle.axis.z) < 0.7 ? V3d(0, 0, 1) : V3d(1, 0, 0)).normalized();
  const V3d e2 = circle.axis.cross(e1);
  add_curve(
      [&](double part) {
        const double t = 2 * std::numbers::pi * part;
        return circle.axis * circle.cosine + (e1 * std::cos(t) + e2 * std::sin(t)) * circle.sine;
      },
      true, width, projection, coverage);
}

void unwind(const Projection& projection, std::vector<ImagePoint>& points) {
  if (!traits_of(projection).has_seam) return;
  const double width = columns(projection);
  for (std::size_t k = 1; k < points.size(); ++k)
    points[k].x -= width * std::round((points[k].x - points[k - 1].x) / width);
}

double winding(const Projection& projection, const std::vector<ImagePoint>& points) {
  if (points.empty() || !traits_of(projection).has_seam) return 0;
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
