// These functions write whole numbers as they stand in sentences.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace domefall {

// Returns "1,234" for 1234.
std::string with_commas(std::size_t count);

// Returns "1 row" or "1,234 rows" for `what` = "row".
std::string counted(std::size_t count, std::string_view what);

}  // namespace domefall
