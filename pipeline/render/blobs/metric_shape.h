// The shape of a star's blob follows from the projection's metric where blob_shape.h has no
// formulas for the projection.
#pragma once

#include "pipeline/render/blobs/blob_shape.h"

namespace domefall {

// Says whether blob_shape<kDome>(), and the loops that are made of it, hold for a projection.  They
// serve the two projections in which most frames are drawn.
inline bool has_blob_loops(const Projection& p) {
  return std::holds_alternative<Domemaster>(p) || std::holds_alternative<Stereographic>(p);
}

// Returns an upper bound, over all directions, of the relative change of the image's scale per
// radian.  This is the logarithmic derivative of the angle that a pixel covers, or the curvature of
// the circles of latitude.  It grows without bound towards a pole or the back of a fisheye.
double scale_change_per_radian(const Projection& p, const CameraDirection& n);

// Returns the shape of a blob of width sigma (radians) whose middle is at n.  The metric is that at
// n and must not be degenerate.
BlobShape blob_shape(const Projection& p, const PixelMetric& metric, const CameraDirection& n,
                     double sigma);

}  // namespace domefall
