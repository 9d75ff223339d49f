// These functions check the bounds that the parameters of an orbit must keep.
#pragma once

#include <string>

namespace domefall {

// This is c in km/s, because errors name a bound on a speed in both units.
inline constexpr double kLightSpeedKmPerS = 299792.458;

// Each throws std::domain_error unless the finite value keeps its bound, which NaN never does.  The
// message is one line, such as "periastron must exceed 4 (units of M), got 3.9: WHY".
void require_above(const char* name, const char* unit, double value, double bound,
                   const std::string& why);
void require_below(const char* name, const char* unit, double value, double bound,
                   const std::string& why);
void require_at_least(const char* name, const char* unit, double value, double bound,
                      const std::string& why);
void require_eccentricity(double e);  // from 0 to below 1

}  // namespace domefall
