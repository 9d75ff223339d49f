// This file writes numbers as messages give them.
#pragma once

#include <string>

namespace domefall {

// Returns at most ten significant digits, as people write them: "1", "0.05", "1e12", "1e-6",
// "infinity".
std::string short_number(double value);

}  // namespace domefall
