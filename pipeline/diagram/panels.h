// The panels of a show's page, each drawn into a box with its heading above and its notes below.
#pragma once

#include <functional>
#include <string>

#include "pipeline/diagram/axis.h"
#include "pipeline/diagram/path.h"
#include "pipeline/diagram/svg.h"

namespace domefall {

// r against show time.  The axis is logarithmic where r spans more than a factor of 20; the horizon
// and the light circle are marked to the right.
void draw_radius_panel(Svg& page, const PageBox& box, const Show& show, const Path& path);

// Without a hole: speed, a part of that of light, against show time.
void draw_speed_panel(Svg& page, const PageBox& box, const Show& show, const Path& path);

// The orbital plane from its north, the start to the right of the hole.  The box is square.
void draw_orbit_panel(Svg& page, const PageBox& box, const Path& path);

// The box is twice as wide as high; the labels of the infinities stand around it.
void draw_penrose_panel(Svg& page, const PageBox& box, const Path& path);

// ---- what the panels share ----

// Of a segment; the colours repeat after eight.
std::string segment_colour(int segment);

void draw_heading(Svg& page, const PageBox& box, const std::string& text);

// The path as curves in the segments' colours, unbroken in regions I and II, dashed in III and
// dotted in IV, with an arrow on each segment, a dot at each instant, a ring at the start and a
// square at the end.
void draw_path(Svg& page, const Path& path, const std::function<PagePoint(const PathPoint&)>& place,
               bool (*joined)(const PathPoint&, const PathPoint&));

// What those marks mean, in one line from `at`.
void draw_key(Svg& page, const PagePoint& at, const Path& path);

}  // namespace domefall
