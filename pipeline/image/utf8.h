// The characters of UTF-8 text.
#pragma once

#include <cstddef>
#include <string_view>

namespace domefall {

// Says whether a byte continues the character of the byte before, as all 10xxxxxx do.
constexpr bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Returns the length of the well-formed character at the start of the text, or 0 if there is none.
// Overlong forms, surrogates and what lies beyond U+10FFFF are not well-formed (Unicode table 3-7).
std::size_t character_length(std::string_view text);

}  // namespace domefall
