#include "trajectories/short_number.h"

#include <fmt/format.h>

#include <cmath>

namespace domefall {

std::string short_number(double value) {
  if (std::isinf(value)) return value < 0 ? "minus infinity" : "infinity";
  std::string text = fmt::format("{:.10g}", value);
  const auto e = text.find('e');
  if (e == std::string::npos) return text;
  const auto digits = text.find_first_not_of('0', e + 2);
  return text.substr(0, e + 1) + (text[e + 1] == '-' ? "-" : "") + text.substr(digits);
}

}  // namespace domefall
