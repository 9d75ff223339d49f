// These functions take rays near a spinning hole as users give them, and throw InputError for what is
// no ray.  The message names no place, which the caller knows.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/light/kerr_start.h"

namespace domefall {

// Takes spin and charge with a^2 + q^2 <= 1, r (M) from the inner horizon to 1e12, and theta from 0 to
// pi.
KerrPlace kerr_place(const KerrHole& hole, long double r, long double theta);

// Returns the part of a decimal number that its rounding has lost.  The text is such a number.
long double lost_digits(const std::string& text);

// Takes an angle delta (radians, 0 to pi) from -R.
KerrDirection kerr_direction(long double delta, long double eta);

// Takes an offset (radians) from an edge, which is silhouette or, between the horizons, region3.
KerrDirection kerr_direction_at_edge(const KerrPlace& at, std::string_view edge, long double offset,
                                     long double eta);

// Returns the delta of a direction.
long double kerr_delta(const KerrPlace& at, const KerrDirection& direction);

}  // namespace domefall
