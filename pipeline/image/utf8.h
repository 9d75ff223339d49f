// These functions find the characters of UTF-8 text, and the bytes that belong to none.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace domefall {

// Says whether a byte continues the character of the byte before, as all 10xxxxxx do.
constexpr bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Returns the length of the well-formed character at the start of the text, or 0 if there is none.
// Overlong forms, surrogates and what lies beyond U+10FFFF are not well-formed (Unicode table 3-7).
std::size_t character_length(std::string_view text);

// Returns the beginning of a well-formed text, of `most` characters at most.
std::string_view first_characters(std::string_view text, std::size_t most);

// Returns the text with each byte that belongs to no well-formed character written as \xFF, and
// a well-formed text as it is.
std::string spell_bad_bytes(std::string_view text);

}  // namespace domefall
