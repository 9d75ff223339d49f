#include <algorithm>
#include <cmath>

#include "pipeline/program/diagram/draw_panels.h"

namespace domefall {
namespace {

struct Plane {
  Scale x, y;
};

PagePoint in_plane(const PathPoint& p) {
  return {p.r * std::cos(p.azimuth), p.r * std::sin(p.azimuth)};
}

// Returns the scales of the least square that holds the path and the light circle, widened by a
// tenth.
Plane frame_of(const PageBox& box, const Path& path) {
  PageBox around{-3, -3, 3, 3};
  for (const PathPoint& p : path.points) {
    const PagePoint at = in_plane(p);
    around.left = std::min(around.left, at.x);
    around.right = std::max(around.right, at.x);
    around.top = std::min(around.top, at.y);
    around.bottom = std::max(around.bottom, at.y);
  }
  const double half = 0.55 * std::max(around.width(), around.height());
  const double x = (around.left + around.right) / 2, y = (around.top + around.bottom) / 2;
  return {{x - half, x + half, box.left, box.right}, {y - half, y + half, box.bottom, box.top}};
}

void draw_hole(Svg& page, const Plane& plane) {
  constexpr double kVisible = 2;  // pixels
  const PagePoint centre{plane.x(0), plane.y(0)};
  const double pixels = plane.x(1) - plane.x(0);
  page.circle(centre, std::max(2 * pixels, kVisible), "#16181d");
  if (pixels > 1) {
    Stroke dashed{"#16181d", 1.2, "5 4"};
    page.circle(centre, 3 * pixels, "none", dashed);
  }
}

}  // namespace

PlaceOnPage draw_orbit_panel(Svg& page, const PageBox& box, const Path& path) {
  const Plane plane = frame_of(box, path);
  draw_heading(page, box, "Orbit from above (M)");
  page.begin_group("orbit");
  draw_axes(page, box, plane.x, plane.y, 7, 7);
  draw_hole(page, plane);
  PlaceOnPage place = [plane](const PathPoint& p) {
    const PagePoint at = in_plane(p);
    return PagePoint{plane.x(at.x), plane.y(at.y)};
  };
  draw_path(page, path, place, is_joined_in_plane);
  draw_key(page, {box.left, box.bottom + 44}, path);
  std::string note = "Disc: the hole, r = 2; dashed: light circle, r = 3.";
  if (path.has_gaps_in_plane)
    note += " Of many turns the first and last " + number_text(kTurnsDrawn) + ".";
  page.text({box.left, box.bottom + 66}, note, {12, "#5a606c"});
  page.end_group();
  return place;
}

}  // namespace domefall
