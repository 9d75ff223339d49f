// Text as bytes: the characters of UTF-8 and the bytes that belong to none, other encodings, and
// characters that steer a terminal, end a line of a list or look like others.
#pragma once

#include <cstddef>
#include <filesystem>
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

// Returns the code of a well-formed character.
char32_t code_of_character(std::string_view character);

// Returns the text with the letters A to Z small.  Others have no case here, whatever the locale
// is.
inline std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

// Returns the beginning of a well-formed text, of `most` characters at most.
std::string_view first_characters(std::string_view text, std::size_t most);

// Returns the text with each byte that belongs to no well-formed character written as \xFF, and
// a well-formed text as it is.
std::string spell_bad_bytes(std::string_view text);

// Returns a name or a title as a terminal shows it on one line.  Control characters, the ends of
// lines, the marks that turn the direction of writing, and bytes that belong to no well-formed
// character are written as \n, \x1B, \u202E or \xFF.
std::string printable(std::string_view text);

// Returns the same of a text of several lines, whose line ends and tabs are kept.
std::string printable_lines(std::string_view text);

// Returns the first control character (below U+0020, U+007F to U+009F) or separator of lines or
// paragraphs (U+2028, U+2029) of a text, or nothing if it has none.
std::string_view first_control_character(std::string_view text);

// Throws InputError if a path or a name holds such a character, which a list, a script or another
// program would take for something else.  The message begins with `place`, such as "--out ".
void refuse_control_characters(std::string_view text, std::string_view place = {});

// Text comes from other programs in UTF-8, or in UTF-16 as spreadsheets and Windows' Notepad may
// save it, with a byte-order mark or without.
enum class TextEncoding { kUtf8, kUtf16Little, kUtf16Big, kUtf32 };

// Returns the encoding by the mark or, without one, by the first character.  Where that is one of
// ASCII, as in every table, show and list of subtitles, half of its two bytes in UTF-16 is 0.
// Anything that is not known otherwise counts as UTF-8.
TextEncoding text_encoding(std::string_view bytes);

// Returns the text behind a byte-order mark of UTF-8, or all of it where there is none.
std::string_view without_byte_order_mark(std::string_view text);

// Returns the text in UTF-8 without a mark.  UTF-8 itself is not checked, since tables also hold
// names in older encodings.  Throws InputError, which names the file, for UTF-32 and for UTF-16
// that is damaged.
std::string as_utf8(std::string bytes, const std::filesystem::path& file);

// Describes the first character of a text that is invisible, or a space, sign, quote, letter or
// digit that looks like one of ASCII: "begins with an en dash (U+2013), not a minus", "has a zero
// width space (U+200B) in it" or "ends with ...".  Returns an empty text where there is none.  Text
// that was pasted from a page or a word processor has such characters, and who reads "got '-3'"
// cannot see what is wrong.  Letters of other alphabets do not count where text may well be Greek
// or Cyrillic, such as the name of a file.
std::string odd_character(std::string_view text, bool letters_too = true);

}  // namespace domefall
