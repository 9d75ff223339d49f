// The shape of a star's blob follows from the projection's metric where blob_shape.h has no
// formulas for the projection.
#pragma once

#include "pipeline/render/blobs/blob_shape.h"

namespace domefall {

// Says whether blob_shape<kDome>(), and the loops that are made of it, hold for a projection.  They
// serve the two projections in which most frames are drawn.
inline bool has_blob_loops(const Projection& p) { return is_domemaster(p) || keeps_circles(p); }

// Returns the shape of a blob of width sigma (radians) whose middle is at n.  The metric is that at
// n and must not be degenerate.
BlobShape blob_shape(const Projection& p, const PixelMetric& metric, const CameraDirection& n,
                     double sigma);

}  // namespace domefall
