#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "pipeline/program/diagram/draw_panels.h"

namespace domefall {
namespace {

// Where a segment of the show is so much farther out than another, the one would leave nothing of
// the other on an even scale.
constexpr double kMuchFarther = 30;

// The circle up to which the panel is even then takes this part of its width.
constexpr double kEvenPart = 0.55;

constexpr const char* kErgosphere = "#cfd4dd";

// Returns r of the ergosphere's outside where cos(theta) is that of the latitude.
double ergosphere(const SpinningHole& hole, double cosine) {
  const auto a = static_cast<double>(hole.kerr.spin), q = static_cast<double>(hole.kerr.charge);
  return 1 + std::sqrt(1 - a * a * cosine * cosine - q * q);
}

struct Plane {
  Scale x, y;
  double even_to = HUGE_VAL;  // beyond this r the distance from the middle is logarithmic
  double stretch = 0;         // of the logarithm

  double distance(double r) const {
    return r <= even_to ? r : even_to * (1 + stretch * std::log(r / even_to));
  }
  PagePoint in_plane(const PathPoint& p) const {
    const double out = distance(p.r) * p.sine;
    return {out * std::cos(p.azimuth), out * std::sin(p.azimuth)};
  }
};

// A Reach is the farthest that a segment gets from the hole.
struct Reach {
  double r = 0;
  bool moves = false;  // whether the segment's path is more than a dot beside that
};

std::vector<Reach> reaches(const Path& path) {
  constexpr double kDot = 0.05;
  std::map<int, Reach> of_segment;
  std::map<int, PathPoint> first;
  for (const PathPoint& p : path.points) {
    Reach& reach = of_segment[p.segment];
    reach.r = std::max(reach.r, p.r);
    const PagePoint at = Plane{}.in_plane(p),
                    from = Plane{}.in_plane(first.try_emplace(p.segment, p).first->second);
    reach.moves |= std::hypot(at.x - from.x, at.y - from.y) > kDot * reach.r;
  }
  std::vector<Reach> reaches;
  reaches.reserve(of_segment.size());
  for (const auto& [segment, reach] : of_segment) reaches.push_back(reach);
  std::ranges::sort(reaches, {}, &Reach::r);
  return reaches;
}

double round_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::ceil(value / unit) * unit;
}

// Returns the r up to which the panel is even.  It holds all segments below the widest gap between
// their reaches, and the light circle.  There is no gap where those below it are dots.
double even_to(const std::vector<Reach>& far) {
  double widest = kMuchFarther, end = HUGE_VAL;
  bool moves = false;
  for (std::size_t k = 1; k < far.size(); ++k) {
    moves |= far[k - 1].moves;
    const double near = std::max(far[k - 1].r, 3.0);
    if (moves && far[k].r > widest * near) widest = far[k].r / near, end = round_up(1.1 * near);
  }
  return end;
}

// Returns the scales of a square about the hole that holds the whole path.
Plane compressed_frame(const PageBox& box, double even, double far) {
  Plane plane{{}, {}, even, (1 / kEvenPart - 1) / std::log(far / even)};
  const double half = 1.08 * plane.distance(far);
  plane.x = {-half, half, box.left, box.right};
  plane.y = {-half, half, box.bottom, box.top};
  return plane;
}

// Returns the scales of the least square that holds the path and the light circle, widened by a
// tenth.
Plane frame_of(const PageBox& box, const Path& path) {
  const std::vector<Reach> far = reaches(path);
  if (const double even = even_to(far); even < HUGE_VAL)
    return compressed_frame(box, even, far.back().r);
  PageBox around{-3, -3, 3, 3};
  for (const PathPoint& p : path.points) {
    const PagePoint at = Plane{}.in_plane(p);
    around.left = std::min(around.left, at.x);
    around.right = std::max(around.right, at.x);
    around.top = std::min(around.top, at.y);
    around.bottom = std::max(around.bottom, at.y);
  }
  const double half = 0.55 * std::max(around.width(), around.height());
  const double x = (around.left + around.right) / 2, y = (around.top + around.bottom) / 2;
  return {{x - half, x + half, box.left, box.right}, {y - half, y + half, box.bottom, box.top}};
}

// Draws circles about the hole instead of axes, which an uneven plane does not have: two within its
// even part, a heavier one about this, and at most five beyond, clear of that.
void draw_circles(Svg& page, const PageBox& box, const Plane& plane, const Path& path) {
  constexpr double kClear = 18;  // pixels
  const PagePoint centre{plane.x(0), plane.y(0)};
  const auto radius = [&](double r) { return plane.x(plane.distance(r)) - centre.x; };
  const double far = reaches(path).back().r;
  std::vector<double> radii;
  for (const double r : axis_marks({0, plane.even_to, 0, 1}, 3))
    if (r > 3 && r < 0.9 * plane.even_to) radii.push_back(r);
  const int decades = static_cast<int>(std::ceil(std::log10(far / plane.even_to))),
            every = (decades + 4) / 5;
  for (double r = std::pow(10, std::ceil(std::log10(plane.even_to))); r <= far;
       r *= std::pow(10, every))
    if (radius(r) > radius(plane.even_to) + kClear) radii.push_back(r);
  for (const double r : radii) page.circle(centre, radius(r), "none", {"#d5d9e1", 1});
  page.circle(centre, radius(plane.even_to), "none", {"#8d94a1", 1.6});
  radii.push_back(plane.even_to);
  // The numbers stand on the circles, up and to the left.
  for (const double r : radii)
    page.text({centre.x - 0.6 * radius(r), centre.y - 0.8 * radius(r) + 4}, number_text(r),
              {12, "#5a606c", "middle", false, false, true});
  page.frame(box, {"#8d94a1", 1});
}

// The hole is a disc up to its horizon, and an inner horizon a light ring on it.
void draw_hole(Svg& page, const Plane& plane, const Spacetime& spacetime) {
  constexpr double kVisible = 2;  // pixels
  const PagePoint centre{plane.x(0), plane.y(0)};
  const double pixels = plane.x(1) - plane.x(0);
  if (const auto* hole = std::get_if<SpinningHole>(&spacetime.kind()))
    page.circle(centre, ergosphere(*hole, 0) * pixels, kErgosphere);
  if (!spacetime.is<Wormhole>())
    page.circle(centre, std::max(spacetime.horizon() * pixels, kVisible), "#16181d");
  if (!(pixels > 1)) return;
  const Stroke dashed{"#16181d", 1.2, "5 4"}, light{"#8d94a1", 1.2};
  for (const RadiusMark& mark : radius_marks(spacetime))
    if (!mark.is_horizon)
      page.circle(centre, mark.r * pixels, "none", dashed);
    else if (mark.r < spacetime.horizon())
      page.circle(centre, mark.r * pixels, "none", light);
}

// Draws half of the meridian plane: the distance from the axis, and the height above the equator.
PageBox side_of(const Path& path) {
  double out = 4, high = 2.2;
  for (const PathPoint& p : path.points)
    out = std::max(out, p.r * p.sine), high = std::max(high, p.r * std::abs(p.cosine));
  const double half = 0.54 * std::max(out, 2 * high);
  return {-0.08 * half, -half, 1.92 * half, half};
}

// Returns the outline of a surface r(cos(theta)) in that plane.
template <class Radius>
std::vector<PagePoint> outline(const Scale& out, const Scale& up, const Radius& radius) {
  constexpr int kSteps = 90;
  std::vector<PagePoint> points;
  for (int k = 0; k <= kSteps; ++k) {
    const double theta = std::numbers::pi * k / kSteps, r = radius(std::cos(theta));
    points.push_back({out(r * std::sin(theta)), up(r * std::cos(theta))});
  }
  return points;
}

// Returns what the disc and the circles are, such as "Disc: the hole, r = 2; dashed: light circle, r =
// 3."
std::string note_of(const Spacetime& spacetime) {
  std::string note = spacetime.horizon() > 0
                         ? "Disc: the hole, r = " + number_text(spacetime.horizon())
                     : spacetime.is<Wormhole>() ? ""
                                                : "Dot: the singularity";
  for (const RadiusMark& mark : radius_marks(spacetime)) {
    // The circles about a spin have a line of their own.
    if (mark.r == spacetime.horizon() || (spacetime.is<SpinningHole>() && !mark.is_horizon))
      continue;
    note += note.empty() ? "" : "; ";
    note += (mark.is_horizon ? "ring: "
             : note.empty()  ? "Dashed: "
                             : "dashed: ") +
            mark.name + ", r = " + number_text(mark.r);
  }
  return note + ".";
}

}  // namespace

PlaceOnPage draw_orbit_panel(Svg& page, const PageBox& box, const Spacetime& spacetime,
                             const Path& path) {
  const Plane plane = frame_of(box, path);
  const bool is_even = plane.even_to == HUGE_VAL;
  draw_heading(page, box,
               is_even ? fmt::format("Orbit from above ({})", unit_of(spacetime))
                       : fmt::format("Orbit from above ({}), logarithmic beyond r = {}",
                                     unit_of(spacetime), number_text(plane.even_to)));
  page.begin_group("orbit");
  if (is_even)
    draw_axes(page, box, plane.x, plane.y, 7, 7);
  else
    draw_circles(page, box, plane, path);
  draw_hole(page, plane, spacetime);
  PlaceOnPage place = [plane](const PathPoint& p) {
    const PagePoint at = plane.in_plane(p);
    return PagePoint{plane.x(at.x), plane.y(at.y)};
  };
  draw_path(page, path, place, is_joined_in_plane);
  draw_key(page, {box.left, box.bottom + 44}, path);
  std::string note = note_of(spacetime);
  if (const auto* hole = std::get_if<SpinningHole>(&spacetime.kind())) {
    const std::string further[] = {
        fmt::format("Dashed: the circles of light, with the spin r = {}, against it r = {}.",
                    number_text(kerr_light_circle(hole->kerr, true)),
                    number_text(kerr_light_circle(hole->kerr, false))),
        fmt::format("Grey: the ergosphere, to r = {} in the equator; all there turns "
                    "counter-clockwise.",
                    number_text(ergosphere(*hole, 0)))};
    double y = box.bottom + 66;
    for (const std::string& line : further) page.text({box.left, y += 18}, line, {12, "#5a606c"});
  }
  if (path.has_gaps_in_plane)
    note += " Of many turns the first and last " + number_text(kTurnsDrawn) + ".";
  page.text({box.left, box.bottom + 66}, note, {12, "#5a606c"});
  page.end_group();
  return place;
}

PlaceOnPage draw_side_panel(Svg& page, const PageBox& box, const SpinningHole& hole,
                            const Path& path) {
  const PageBox plane = side_of(path);
  const Scale out{plane.left, plane.right, box.left, box.right},
      up{plane.top, plane.bottom, box.bottom, box.top};
  draw_heading(page, box, "From the side (M): distance from the axis, height above the equator");
  page.begin_group("side");
  draw_axes(page, box, out, up, 7, 7);
  page.line({out(0), box.top}, {out(0), box.bottom}, {"#8d94a1", 1.2, "8 3 2 3"});
  page.area(outline(out, up, [&](double cosine) { return ergosphere(hole, cosine); }), kErgosphere);
  page.area(outline(out, up, [&](double) { return hole.horizon(); }), "#16181d");
  page.curve(outline(out, up, [&](double) { return hole.inner_horizon(); }), {"#8d94a1", 1.2});
  for (const bool prograde : {true, false})
    page.circle({out(kerr_light_circle(hole.kerr, prograde)), up(0)}, 3, "none", {"#16181d", 1.2});
  PlaceOnPage place = [out, up](const PathPoint& p) {
    return PagePoint{out(p.r * p.sine), up(p.r * p.cosine)};
  };
  draw_path(page, path, place, is_joined_in_plane);
  page.text({box.left, box.bottom + 44},
            "Black: the hole; grey: the ergosphere; rings: the circles of light in the equator.",
            {12, "#5a606c"});
  page.end_group();
  return place;
}

}  // namespace domefall
