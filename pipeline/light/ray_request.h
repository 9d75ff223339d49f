// These functions read rays as users give them, by names and numbers, in a row of `domefall trace`
// or in elements of arrays.
//
// Each function throws InputError for what is no ray.  The message names no place, which the caller
// knows.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/light/traced_ray.h"

namespace domefall {

// Takes rain, static, outgoing, T_II or T_IV.
TraceObserver trace_observer(std::string_view name);

// Takes one of kTraceMethods.
TraceMethod trace_method(std::string_view name);

// Reads a finite decimal number.  `name` is what a message calls it.
long double decimal_number(const std::string& text, const char* name);

// Reads a radius (M) from its decimals, which keep the distances from the horizon and the light
// circle that a double of an r near them would lose.
Radius decimal_radius(const std::string& text);

// Makes a ray by its angle delta (radians, 0 to pi) from -R.  r must be from 1e-9 to 1e12 (M).
// Beyond, the silhouette is a point to double precision, and below, the two skies touch.  A static
// observer has r > 2, and T_II and T_IV have r < 2.
RayRequest ray_at_angle(TraceObserver observer, const Radius& at, long double delta);

// Makes a ray by its offset (radians) from an edge, which is silhouette or region3.  The sum must
// be an angle from 0 to pi, and the radius is limited as above.
RayRequest ray_at_edge(TraceObserver observer, const Radius& at, std::string_view edge,
                       double offset);

// Refuses an angle delta, given beside an edge, that is not the edge's plus the offset.  It may not
// differ by more than 1e-9 of the edge's angle and the offset together.
void require_delta(long double delta, long double edge, long double offset);
void require_delta(const RayRequest& at_edge, long double delta);

}  // namespace domefall
