// What an orbit must keep to, and how a request that does not is refused: std::domain_error with one
// line such as "periastron must exceed 4 (units of M), got 3.9: ...".
#pragma once

#include <string>

namespace domefall {

// c in km/s: errors name a bound on a speed in both units.
inline constexpr double kLightSpeedKmPerS = 299792.458;

// Ten digits, or fewer where they say as much.
std::string bound_text(double value);

// Throws unless value > bound (which no NaN does).  `why` follows the colon.
void require_above(const char* name, const char* unit, double value, double bound,
                   const std::string& why);
void require_below(const char* name, const char* unit, double value, double bound,
                   const std::string& why);
void require_at_least(const char* name, const char* unit, double value, double bound,
                      const std::string& why);

}  // namespace domefall
