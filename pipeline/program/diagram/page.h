// This file draws on one page where a show's observer goes, and when.
#pragma once

#include <string>
#include <vector>

#include "pipeline/program/diagram/svg.h"
#include "pipeline/show/show.h"

namespace domefall {

// Returns an SVG document with r against show time, the orbit from above, and the path in the
// Carter-Penrose diagram.  In flat space, where the place does not change, it has the speed alone.
// It depends on the show alone, and takes a second or less.
std::string show_page(const Show& show);

// A MarkedPage says where the present stands in the panels, for programs that draw a mark there.
struct MarkedPage {
  std::string svg;               // as show_page() draws it
  double width = 0, height = 0;  // of the page, in its pixels
  double step_s = 0;             // seconds of show from one instant to the next
  // Each instant from the start to the end has its place in each panel.  The panels are those of
  // the radius, the orbit and the Carter-Penrose diagram or, in flat space, that of the speed
  // alone.
  std::vector<std::vector<PagePoint>> places;
};

// Places are interpolated linearly between the points that the page draws, at `instants` (>= 2)
// even times.
MarkedPage marked_page(const Show& show, int instants);

}  // namespace domefall
