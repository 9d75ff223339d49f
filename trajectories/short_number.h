// Numbers as messages give them.
#pragma once

#include <string>

namespace domefall {

// At most ten significant digits, without trailing zeros: "1", "0.05", "1e+08", "inf".
std::string short_number(double value);

}  // namespace domefall
