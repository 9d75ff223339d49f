// These functions draw the panels of a show's page.  Each panel is drawn into a box, with its
// heading above and its notes below, and tells where on the page it has a point of the path.
#pragma once

#include <functional>
#include <string>

#include "pipeline/program/diagram/axis.h"
#include "pipeline/program/diagram/path.h"
#include "pipeline/program/diagram/svg.h"

namespace domefall {

using PlaceOnPage = std::function<PagePoint(const PathPoint&)>;

// Draws r against show time.  The axis is logarithmic where r spans more than a factor of 20.  The
// horizon and the light circle are named to the right.
PlaceOnPage draw_radius_panel(Svg& page, const PageBox& box, const Show& show, const Path& path);

// Draws the speed, as a fraction of that of light, against show time.  This is for shows without a
// hole.
PlaceOnPage draw_speed_panel(Svg& page, const PageBox& box, const Show& show, const Path& path);

// Draws the orbital plane seen from its north, with the start to the right of the hole.  The box
// must be square.  Where a segment reaches more than 30 times as far as the next, radii beyond the
// nearer ones are logarithmic, and circles with numbers stand in for the axes.
PlaceOnPage draw_orbit_panel(Svg& page, const PageBox& box, const Spacetime& spacetime,
                             const Path& path);

// Draws the path about a hole that spins as seen from its equator, whatever its azimuth.  The box must be
// square.
PlaceOnPage draw_side_panel(Svg& page, const PageBox& box, const SpinningHole& hole,
                            const Path& path);

// Draws the path in the Carter-Penrose diagram.  The box must be twice as wide as high, and the
// labels of the infinities stand around it.
PlaceOnPage draw_penrose_panel(Svg& page, const PageBox& box, const Path& path);

// Draws the path in the diagrams of a charged hole, with the universes that it visits, and of a
// wormhole.  Labels and a note of two lines stand around the box, which `blocks_box` makes.
PageBox blocks_box(const PagePoint& top_left, double width, const Spacetime& spacetime,
                   const Path& path);
PlaceOnPage draw_blocks_panel(Svg& page, const PageBox& box, const Spacetime& spacetime,
                              const Path& path);

// ---- what the panels share ----

// A RadiusMark is a radius that a spacetime is known by.
struct RadiusMark {
  double r;
  std::string name;
  bool is_horizon;
};
// Returns them from the innermost on.
std::vector<RadiusMark> radius_marks(const Spacetime& spacetime);
// Returns the unit of lengths: M, or radii of the throat.
const char* unit_of(const Spacetime& spacetime);

// Says why t = 0 lies where it does in the diagram.
std::string origin_note(const Path& path, const char* unit);

// Returns the colour of a segment.  The colours repeat after eight.
std::string segment_colour(int segment);

void draw_heading(Svg& page, const PageBox& box, const std::string& text);

// Draws the path as curves in the colours of the segments, unbroken in regions I, II and V, dashed in
// III and VI, and dotted in IV.  Each segment has an arrow, if its curve is long enough, and each instant a
// small disc.  A ring marks the start, and a square the end.
void draw_path(Svg& page, const Path& path, const PlaceOnPage& place,
               bool (*joined)(const PathPoint&, const PathPoint&));

// Says in one line from `at` what those marks mean.
void draw_key(Svg& page, const PagePoint& at, const Path& path);

}  // namespace domefall
