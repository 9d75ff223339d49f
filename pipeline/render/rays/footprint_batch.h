// What pixels see of a sky map: from looks to the footprints in FootprintBatch, many at a time.
#pragma once

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {

// The parts of FootprintBatch that a footprint is.
struct FootprintColumns {
  float *x, *y, *z, *wide, *narrow, *ax, *ay, *az;
};

// Of looks that each stand for `angle` radians of the view.
void set_footprints(const ViewRayBatch& batch, const double* angle, int count,
                    const FootprintColumns& places);

}  // namespace domefall
