// What pixels see of a sky map: from looks to SkyPlaces, many at a time.
#pragma once

#include "pipeline/render/sky_sampler.h"
#include "pipeline/render/view_tracer.h"

namespace domefall {

// Places and footprints, from element `first` of `places` on, of looks that each stand for `angle` radians
// of the view.  Not what becomes of the light.
void set_footprints(const LookBatch& batch, const double* angle, int count, int first,
                    SkyPlaces& places);

}  // namespace domefall
