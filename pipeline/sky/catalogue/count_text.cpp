#include "pipeline/sky/catalogue/count_text.h"

#include <fmt/format.h>

namespace domefall {

std::string with_commas(std::size_t count) {
  std::string digits = fmt::to_string(count);
  // The commas go in from the right, so that the places of those to come do not move.
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", with_commas(count), what, count == 1 ? "" : "s");
}

}  // namespace domefall
