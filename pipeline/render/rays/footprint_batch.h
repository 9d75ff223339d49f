// The footprints that view rays have on the sky, many at a time.
#pragma once

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

// Where footprints are written: direction, longer and shorter side (radians on the sky), and the
// vector along the longer side, as long as it.
struct FootprintColumns {
  float *x, *y, *z, *wide, *narrow, *ax, *ay, *az;
};

// Sets the footprints of view rays, each of which stands for `angle` radians of the view.
void set_footprints(const ViewRayBatch& batch, const double* angle, int count,
                    const FootprintColumns& footprints);

}  // namespace domefall
