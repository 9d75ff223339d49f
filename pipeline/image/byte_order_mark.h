// Spreadsheets and editors begin what they save as UTF-8 with this mark.
#pragma once

#include <string_view>

namespace domefall {

// Returns the text behind the mark, or all of it where there is none.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

}  // namespace domefall
