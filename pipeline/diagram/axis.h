// From a quantity to a place on the page, and the marks of an axis.
#pragma once

#include <string>
#include <vector>

#include "pipeline/diagram/svg.h"

namespace domefall {

// Affine in the value or, logarithmic, in its logarithm (from, to > 0).  from != to.
struct Scale {
  double from = 0, to = 1;        // values
  double at_from = 0, at_to = 1;  // pixels
  bool logarithmic = false;

  double operator()(double value) const;
};

// Round values within [from, to], about `count` of them: equal steps of 1, 2 or 5; on a logarithmic
// axis 1, 2, 5 of each decade, or decades alone where there are many.
std::vector<double> axis_marks(const Scale& scale, int count);

// "0.05", "2000", from 10^5 on and below 10^-3 as "2x10^6" with raised digits.
std::string number_text(double value);

// Frame, grid lines and numbers below and to the left of a box.
void draw_axes(Svg& page, const PageBox& box, const Scale& x, const Scale& y, int x_marks,
               int y_marks);

}  // namespace domefall
