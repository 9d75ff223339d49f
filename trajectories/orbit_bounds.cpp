#include "trajectories/orbit_bounds.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "trajectories/short_number.h"

namespace domefall {
namespace {

[[noreturn]] void refuse(const char* name, const char* must, const char* unit, double value,
                         double bound, const std::string& why) {
  throw std::domain_error(fmt::format("{} must {} {} ({}), got {}: {}", name, must,
                                      short_number(bound), unit, short_number(value), why));
}

}  // namespace

void require_above(const char* name, const char* unit, double value, double bound,
                   const std::string& why) {
  if (!(value > bound) || std::isinf(value)) refuse(name, "exceed", unit, value, bound, why);
}

void require_below(const char* name, const char* unit, double value, double bound,
                   const std::string& why) {
  if (!(value < bound)) refuse(name, "be below", unit, value, bound, why);
}

void require_at_least(const char* name, const char* unit, double value, double bound,
                      const std::string& why) {
  if (!(value >= bound) || std::isinf(value)) refuse(name, "be at least", unit, value, bound, why);
}

void require_eccentricity(double e) {
  require_at_least("eccentricity", "a number", e, 0, "a circle is the least eccentric orbit");
  require_below("eccentricity", "a number", e, 1, "from 1 on the orbit is not bound");
}

}  // namespace domefall
