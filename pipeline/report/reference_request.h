// Puts a request to trace_ray as the same request to the reference.
#pragma once

#include "pipeline/optics/traced_ray.h"
#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

// The same ray, from the doubles as they are.  Where r is given more finely by its distance from
// the horizon or from the light circle, it is taken from that.
ReferenceRequest reference_request(const RayRequest& q);

SkyRegion origin_from(ReferenceOrigin origin);

}  // namespace domefall
