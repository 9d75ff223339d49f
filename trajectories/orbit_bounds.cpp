#include "trajectories/orbit_bounds.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace domefall {
namespace {

[[noreturn]] void refuse(const char* name, const char* must, const char* unit, double value,
                         double bound, const std::string& why) {
  throw std::domain_error(std::string(name) + " must " + must + " " + bound_text(bound) + " (" +
                          unit + "), got " + bound_text(value) + ": " + why);
}

}  // namespace

std::string bound_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

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

}  // namespace domefall
