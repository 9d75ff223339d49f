#include "pipeline/base/utf8.h"

#include <fmt/format.h>
#include <glib.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

// These embed text of another direction, or override the direction of what follows.
bool turns_writing(char32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

std::string spelt_code(char32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  return code < 0x80 ? fmt::format("\\x{:02X}", static_cast<unsigned>(code))
                     : fmt::format("\\u{:04X}", static_cast<unsigned>(code));
}

template <class IsSpelt>
std::string with_spelt(std::string_view text, const IsSpelt& is_spelt) {
  std::string spelt;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length == 0)
      spelt += fmt::format("\\x{:02X}", static_cast<unsigned char>(text.front()));
    else if (const char32_t code = code_of_character(character); is_spelt(code))
      spelt += spelt_code(code);
    else
      spelt += character;
    text.remove_prefix(character.size());
  }
  return spelt;
}

using namespace std::string_view_literals;

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

constexpr bool is_high_half(char32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
constexpr bool is_low_half(char32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

std::string from_utf16(std::string_view bytes, bool big, const std::filesystem::path& file) {
  std::string text;
  text.reserve(bytes.size());
  const auto fail = [&](std::size_t at, const char* what) {
    throw InputError(fmt::format("{}: byte {}: {}", file.string(), at + 1, what));
  };
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<char32_t>(big ? first << 8 | second : second << 8 | first);
  };
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    if (at + 1 == bytes.size()) fail(at, "the text is UTF-16 and ends within a character");
    char32_t code = unit(at);
    if (at == 0 && code == 0xFEFF) continue;
    if (is_high_half(code)) {
      const bool whole = at + 3 < bytes.size() && is_low_half(unit(at + 2));
      if (!whole) fail(at, "the text is UTF-16, and half of a character is here");
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (is_low_half(code)) {
      fail(at, "the text is UTF-16, and half of a character is here");
    }
    std::array<char, 6> character{};
    text.append(character.data(), g_unichar_to_utf8(code, character.data()));
  }
  return text;
}

// These characters are called by `name` and look like `like`, which is empty for invisible ones.
struct OddRange {
  char32_t first, last;
  std::string_view name, like;
};

// The names are those of Unicode, with words for a range where each has its own.
constexpr std::array kOddRanges{
    OddRange{0x00A0, 0x00A0, "a no-break space", "a space"},
    OddRange{0x00AB, 0x00AB, "an angle quote", "a straight quote"},
    OddRange{0x00AD, 0x00AD, "a soft hyphen", ""},
    OddRange{0x00B4, 0x00B4, "an acute accent", "a straight quote"},
    OddRange{0x00BB, 0x00BB, "an angle quote", "a straight quote"},
    OddRange{0x034F, 0x034F, "a grapheme joiner", ""},
    OddRange{0x0391, 0x03C9, "a Greek letter", "one of a to z"},
    OddRange{0x0400, 0x04FF, "a Cyrillic letter", "one of a to z"},
    OddRange{0x0660, 0x0669, "an Arabic digit", "one of 0 to 9"},
    OddRange{0x066B, 0x066B, "an Arabic decimal separator", "a point"},
    OddRange{0x06F0, 0x06F9, "an Arabic digit", "one of 0 to 9"},
    OddRange{0x1680, 0x1680, "an Ogham space", "a space"},
    OddRange{0x180E, 0x180E, "a vowel separator", ""},
    OddRange{0x2000, 0x200A, "a typographic space", "a space"},
    OddRange{0x200B, 0x200B, "a zero width space", ""},
    OddRange{0x200C, 0x200C, "a zero width non-joiner", ""},
    OddRange{0x200D, 0x200D, "a zero width joiner", ""},
    OddRange{0x200E, 0x200F, "a direction mark", ""},
    OddRange{0x2010, 0x2010, "a hyphen", "a minus"},
    OddRange{0x2011, 0x2011, "a non-breaking hyphen", "a minus"},
    OddRange{0x2012, 0x2012, "a figure dash", "a minus"},
    OddRange{0x2013, 0x2013, "an en dash", "a minus"},
    OddRange{0x2014, 0x2014, "an em dash", "a minus"},
    OddRange{0x2015, 0x2015, "a horizontal bar", "a minus"},
    OddRange{0x2018, 0x201B, "a curly quote", "a straight quote"},
    OddRange{0x201C, 0x201F, "a curly quote", "a straight quote"},
    OddRange{0x2028, 0x2029, "a line separator", ""},
    OddRange{0x202A, 0x202E, "a direction mark", ""},
    OddRange{0x202F, 0x202F, "a narrow no-break space", "a space"},
    OddRange{0x2032, 0x2036, "a prime", "a straight quote"},
    OddRange{0x2039, 0x203A, "an angle quote", "a straight quote"},
    OddRange{0x205F, 0x205F, "a mathematical space", "a space"},
    OddRange{0x2060, 0x2064, "a word joiner", ""},
    OddRange{0x2066, 0x206F, "a direction mark", ""},
    OddRange{0x2212, 0x2212, "a minus sign", "a hyphen-minus (-)"},
    OddRange{0x2236, 0x2236, "a ratio sign", "a colon"},
    OddRange{0x3000, 0x3000, "an ideographic space", "a space"},
    OddRange{0x3001, 0x3001, "an ideographic comma", "a comma"},
    OddRange{0x3002, 0x3002, "an ideographic full stop", "a point"},
    OddRange{0xA789, 0xA789, "a letter colon", "a colon"},
    OddRange{0xFE00, 0xFE0F, "a variation selector", ""},
    OddRange{0xFE55, 0xFE55, "a small colon", "a colon"},
    OddRange{0xFE58, 0xFE58, "a small em dash", "a minus"},
    OddRange{0xFE63, 0xFE63, "a small hyphen-minus", "a minus"},
    OddRange{0xFEFF, 0xFEFF, "a byte-order mark", ""},
    OddRange{0xFF02, 0xFF02, "a full-width quote", "a straight quote"},
    OddRange{0xFF07, 0xFF07, "a full-width quote", "a straight quote"},
    OddRange{0xFF0C, 0xFF0C, "a full-width comma", "a comma"},
    OddRange{0xFF0D, 0xFF0D, "a full-width hyphen-minus", "a minus"},
    OddRange{0xFF0E, 0xFF0E, "a full-width full stop", "a point"},
    OddRange{0xFF10, 0xFF19, "a full-width digit", "one of 0 to 9"},
    OddRange{0xFF1A, 0xFF1A, "a full-width colon", "a colon"},
    OddRange{0xFF01, 0xFF5E, "a full-width character", "the one of ASCII"},
    OddRange{0xFFA0, 0xFFA0, "a Hangul filler", ""},
};

const OddRange* odd_range(char32_t code) {
  const auto found = std::ranges::find_if(
      kOddRanges, [&](const OddRange& each) { return code >= each.first && code <= each.last; });
  return found == kOddRanges.end() ? nullptr : &*found;
}

// Letters of other alphabets are odd only where text can be ASCII alone.
bool is_letter(const OddRange& range) { return range.first >= 0x0391 && range.last <= 0x04FF; }

}  // namespace

std::size_t character_length(std::string_view text) {
  if (text.empty()) return 0;
  if (static_cast<unsigned char>(text[0]) < 0x80) return 1;
  const gunichar code = g_utf8_get_char_validated(text.data(), std::ssize(text));
  return code > 0x10FFFF ? 0 : static_cast<std::size_t>(g_unichar_to_utf8(code, nullptr));
}

char32_t code_of_character(std::string_view character) { return g_utf8_get_char(character.data()); }

std::string_view first_characters(std::string_view text, std::size_t most) {
  std::size_t end = 0, characters = 0;
  for (; end < text.size(); ++end)
    if (!continues_character(text[end]) && ++characters > most) break;
  return text.substr(0, end);
}

std::string spell_bad_bytes(std::string_view text) {
  return with_spelt(text, [](char32_t) { return false; });
}

std::string printable(std::string_view text) {
  return with_spelt(text, [](char32_t code) { return is_control(code) || turns_writing(code); });
}

std::string printable_lines(std::string_view text) {
  return with_spelt(text, [](char32_t code) {
    return code != '\n' && code != '\t' && (is_control(code) || turns_writing(code));
  });
}

std::string_view first_control_character(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length > 0 && is_control(code_of_character(character))) return character;
    text.remove_prefix(character.size());
  }
  return {};
}

void refuse_control_characters(std::string_view text, std::string_view place) {
  const std::string_view found = first_control_character(text);
  if (!found.empty())
    throw InputError(fmt::format(
        "{}{}: has the control character {}, which no path or name may have: lists, scripts and "
        "other programs would take it for something else",
        printable(place), printable(text), printable(found)));
}

TextEncoding text_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv))
    return TextEncoding::kUtf32;
  if (bytes.starts_with("\xFF\xFE")) return TextEncoding::kUtf16Little;
  if (bytes.starts_with("\xFE\xFF")) return TextEncoding::kUtf16Big;
  if (bytes.size() < 2 || (bytes[0] == 0) == (bytes[1] == 0)) return TextEncoding::kUtf8;
  return bytes[1] == 0 ? TextEncoding::kUtf16Little : TextEncoding::kUtf16Big;
}

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
  return text;
}

std::string as_utf8(std::string bytes, const std::filesystem::path& file) {
  const TextEncoding encoding = text_encoding(bytes);
  if (encoding == TextEncoding::kUtf32)
    throw InputError(file.string() + ": this is UTF-32; save it as UTF-8");
  if (encoding != TextEncoding::kUtf8)
    return from_utf16(bytes, encoding == TextEncoding::kUtf16Big, file);
  if (bytes.starts_with(kUtf8Mark)) bytes.erase(0, kUtf8Mark.size());
  return bytes;
}

std::string odd_character(std::string_view text, bool letters_too) {
  std::size_t length = 0;
  for (std::size_t at = 0; at < text.size(); at += length) {
    length = std::max<std::size_t>(character_length(text.substr(at)), 1);
    if (length == 1) continue;
    const char32_t code = code_of_character(text.substr(at, length));
    const OddRange* odd = odd_range(code);
    if (!odd || (is_letter(*odd) && !letters_too)) continue;
    const bool first = at == 0, last = at + length == text.size();
    return fmt::format("{} {} (U+{:04X}){}{}{}",
                       first  ? "begins with"
                       : last ? "ends with"
                              : "has",
                       odd->name, static_cast<unsigned>(code), first || last ? "" : " in it",
                       odd->like.empty() ? "" : ", not ", odd->like);
  }
  return "";
}

}  // namespace domefall
