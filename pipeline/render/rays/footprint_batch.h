// Computes the footprints of many pixels at a time.  A footprint is the ellipse that the view rays
// of a pixel cover on the sky.
#pragma once

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

// FootprintColumns says where footprints are written, column by column.  SampleBatch has such
// columns.
struct FootprintColumns {
  float *x, *y, *z;      // the middle, a unit vector on the sky
  float *wide, *narrow;  // the axes of the ellipse, radians
  float *ax, *ay, *az;   // the longer axis as a vector on the sky, of length `wide`
};

// Sets the footprints of `count` rays.  Ray k stands for the angle angle[k] (radians) in the view.
// The axes of its footprint are this angle times the ray's two scales.
void set_footprints(const ViewRayBatch& batch, const double* angle, int count,
                    const FootprintColumns& footprints);

}  // namespace domefall
