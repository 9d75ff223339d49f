// The footprints of pixels on the sky: the ellipses that their view rays cover there, many at a
// time.
#pragma once

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

// Where to write footprints, column by column.  SampleBatch has such columns.
struct FootprintColumns {
  float *x, *y, *z;      // the middle, a unit vector on the sky
  float *wide, *narrow;  // the axes of the ellipse, radians
  float *ax, *ay, *az;   // the longer axis as a vector on the sky, of length `wide`
};

// Sets the footprints of `count` rays, each of which stands for an angle[k] in the view (radians).
// The axes are the angle times the ray's radial and tangential scales.
void set_footprints(const ViewRayBatch& batch, const double* angle, int count,
                    const FootprintColumns& footprints);

}  // namespace domefall
