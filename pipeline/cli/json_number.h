// Numbers as the verbs write them into JSON.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace domefall {

// All digits of `value`, so that it is read back as it is.  JSON has no infinity and no NaN, for
// which null stands: what has no such value.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace domefall
