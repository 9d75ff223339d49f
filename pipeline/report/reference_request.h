// These functions translate a request to trace_ray() into the same request to the reference, and
// the reference's origins into those of trace_ray().
#pragma once

#include "pipeline/optics/traced_ray.h"
#include "pipeline/report/reference/reference_ray.h"

namespace domefall {

// Returns a request for the same ray, whose numbers have the exact values of the doubles.  Where
// the distance from the horizon or from the light circle gives r more finely, r is taken from that.
ReferenceRequest reference_request(const RayRequest& q);

SkyRegion origin_from(ReferenceOrigin origin);

}  // namespace domefall
