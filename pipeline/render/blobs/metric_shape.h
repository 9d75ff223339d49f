// The shape of a star's blob in a projection without formulas of its own, by the projection's
// metric.
#pragma once

#include "pipeline/render/blobs/blob_shape.h"

namespace domefall {

// Whether blob_shape<kDome>() and the loops that are made of it hold for a projection: they are
// for those in which most frames are drawn.
inline bool has_blob_loops(const Projection& p) {
  return std::holds_alternative<Domemaster>(p) || std::holds_alternative<Stereographic>(p);
}

// The relative change of the image's scale per radian, an upper bound over all directions: the
// logarithmic derivative of the angle that a pixel covers, or how strongly circles of latitude are
// bent.  Grows without bound towards a pole or the back of a fisheye.
double scale_change_per_radian(const Projection& p, const CameraDirection& n);

// The shape of a blob of width sigma (radians) whose middle is at n, with the metric there, which
// must not be degenerate.
BlobShape blob_shape(const Projection& p, const PixelMetric& metric, const CameraDirection& n,
                     double sigma);

}  // namespace domefall
