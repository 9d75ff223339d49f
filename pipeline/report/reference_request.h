// The bridge between a request to trace_ray and the same one to the reference.
#pragma once

#include "pipeline/optics/traced_ray.h"
#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

// The same ray, from the doubles as they are; r by way of its distance from the horizon or the
// light circle where that is finer.
ReferenceRequest reference_request(const RayRequest& q);

SkyRegion origin_from(ReferenceOrigin origin);

}  // namespace domefall
