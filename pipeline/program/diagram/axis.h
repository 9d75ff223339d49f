// This file has scales, which turn a quantity into a place on the page, and the axes that show
// them.
#pragma once

#include <string>
#include <vector>

#include "pipeline/program/diagram/svg.h"

namespace domefall {

// On a Scale the place is affine in the value or, if it is logarithmic, in the value's logarithm.
// `from` and `to` must differ, and must be positive on a logarithmic scale.
struct Scale {
  double from = 0, to = 1;        // values
  double at_from = 0, at_to = 1;  // pixels
  bool logarithmic = false;

  double operator()(double value) const;
};

// Returns about `count` round values within [from, to].  Their equal steps are 1, 2 or 5 times a
// power of ten.  On a logarithmic axis the values are 1, 2 and 5 of each decade or, where there are
// many decades, powers of ten alone.
std::vector<double> axis_marks(const Scale& scale, int count);

// Writes 0.05 as "0.05" and 2e6 as "2×10⁶".  Powers of ten serve from 10^5 on and below 10^-3.
std::string number_text(double value);

// Draws the frame of a box, its grid lines, and their numbers below it and to its left.
void draw_axes(Svg& page, const PageBox& box, const Scale& x, const Scale& y, int x_marks,
               int y_marks);

}  // namespace domefall
