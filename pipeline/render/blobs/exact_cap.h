// Cap blobs in projections that have no formulas for them: by the direction of each pixel, so that
// they are right beside poles and seams, too.
#pragma once

#include "pipeline/render/blobs/cap_blob.h"

namespace domefall {

// As place_cap() and draw_cap(), which call them.  The weight is the mean of exp(-c^2/(2 sigma^2))
// less the cut over points of each pixel, by Gauss' quadrature: within 2.5e-3 of the peak of its
// integral.
bool place_exact_cap(const Projection& projection, CapBlob& blob);
void draw_exact_cap(const CapBlob& blob, const Projection& projection, const Canvas& canvas);

}  // namespace domefall
