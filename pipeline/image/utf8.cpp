#include "pipeline/image/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace domefall {

std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  if (text.empty()) return 0;
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4) return 0;
  // The first byte can narrow the range of the second one, but not those of the others.
  const unsigned low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t k = 2; k < length; ++k)
    if (k >= text.size() || !continues_character(text[k])) return 0;
  return length;
}

std::string_view first_characters(std::string_view text, std::size_t most) {
  std::size_t end = 0, characters = 0;
  for (; end < text.size(); ++end)
    if (!continues_character(text[end]) && ++characters > most) break;
  return text.substr(0, end);
}

std::string spell_bad_bytes(std::string_view text) {
  std::string spelt;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length > 0)
      spelt += text.substr(0, length);
    else
      spelt += fmt::format("\\x{:02X}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return spelt;
}

}  // namespace domefall
