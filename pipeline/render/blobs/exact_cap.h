// These functions draw cap blobs in projections that have no formulas for them.  They use the
// direction of each pixel, so that caps are right beside poles and seams, too.
#pragma once

#include "pipeline/render/blobs/cap_blob.h"

namespace domefall {

// place_cap() and draw_cap() call these functions in such projections, and promise the same.  The
// weight is the mean of exp(-c^2/(2 sigma^2)), minus the cut, over the points of Gauss' quadrature
// in each pixel.  It differs from the integral over the pixel by at most 2.5e-3 of the peak.
bool place_exact_cap(const Projection& projection, CapBlob& blob);
void draw_exact_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas);

}  // namespace domefall
