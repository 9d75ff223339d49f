// This file writes numbers into JSON as the verbs do.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace domefall {

// Keeps all digits of `value`, so that it is read back as it is.  JSON has no infinity and no NaN,
// for which this writes null.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

}  // namespace domefall
