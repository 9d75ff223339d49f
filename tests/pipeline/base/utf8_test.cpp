#include "pipeline/base/utf8.h"

#include <gtest/gtest.h>

#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

TEST(Utf8, ACharacterHasAsManyBytesAsItsFirstOneSays) {
  EXPECT_EQ(character_length("az"), 1U);
  EXPECT_EQ(character_length("\u00e9z"), 2U);
  EXPECT_EQ(character_length("\u2609z"), 3U);
  EXPECT_EQ(character_length("\U0001f30cz"), 4U);
  EXPECT_EQ(character_length("\U0010ffffz"), 4U);
}

TEST(Utf8, WhatIsNotWellFormedIsNoCharacter) {
  for (const char* text : {"\xff", "\x80", "\xc3", "\xc3z", "\xe2\x98", "\xf0\x9f\x8cz", "\xc0\xaf",
                           "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",  // overlong
                           "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"})
    EXPECT_EQ(character_length(text), 0U) << testing::PrintToString(text);
  EXPECT_EQ(character_length(""), 0U);
  // The rest of a character beyond the end of the view is not looked at.
  EXPECT_EQ(character_length(std::string_view("\u00e9").substr(0, 1)), 0U);
}

TEST(Utf8, TheFirstCharactersAreWhole) {
  const std::string text = "a\u00e9\u2609\U0001f30c";
  EXPECT_EQ(first_characters(text, 0), "");
  EXPECT_EQ(first_characters(text, 1), "a");
  EXPECT_EQ(first_characters(text, 2), "a\u00e9");
  EXPECT_EQ(first_characters(text, 3), "a\u00e9\u2609");
  EXPECT_EQ(first_characters(text, 4), text);
  EXPECT_EQ(first_characters(text, 5), text);
}

TEST(Utf8, WhatSteersATerminalIsSpelt) {
  EXPECT_EQ(printable("a\n\r\t\x1b[2J\x07\x7f b"), "a\\n\\r\\t\\x1B[2J\\x07\\x7F b");
  EXPECT_EQ(printable("\u0080\u009b\u009f"), "\\u0080\\u009B\\u009F");
  EXPECT_EQ(printable("\u2028\u2029"), "\\u2028\\u2029");
  EXPECT_EQ(printable("\u202a\u202e\u2066\u2069"), "\\u202A\\u202E\\u2066\\u2069");
  EXPECT_EQ(printable("a\x9b\xff"), "a\\x9B\\xFF");
  EXPECT_EQ(printable_lines("a\n\tb\x1b\xff\u202e\n"), "a\n\tb\\x1B\\xFF\\u202E\n");
  const std::string good = "\u00a0\u2027\u202f\u2065\u206a \u9ed1\u6d1e \U0001f30c \\n";
  EXPECT_EQ(printable(good), good);
}

TEST(Utf8, ControlCharactersAreRefusedInNames) {
  for (const char* name : {"a\nb", "\x1f", "a\x7f", "\u0080", "a\u009f", "a\u2028", "\u2029"}) {
    EXPECT_NE(first_control_character(name), "") << testing::PrintToString(name);
    EXPECT_THROW(refuse_control_characters(name), InputError) << testing::PrintToString(name);
  }
  // Lone bytes are no control characters, and marks of direction belong to names in some scripts.
  for (const char* name : {"", "a b", "\x9b", "\xff", "\u00a0", "\u202e", "\U0001f30c"})
    EXPECT_NO_THROW(refuse_control_characters(name)) << testing::PrintToString(name);
  EXPECT_TRUE(message_of([] {
                refuse_control_characters("a\nb", "--out ");
              }).starts_with("--out a\\nb: has the control character \\n"));
}

TEST(Utf8, BadBytesAreSpeltAndAllElseIsKept) {
  const std::string good = "/a b/\u00e9\U0001f30c\n";
  EXPECT_EQ(spell_bad_bytes(good), good);
  EXPECT_EQ(spell_bad_bytes("/a\xff/\u00e9\xe2\x98z\xc3"), "/a\\xFF/\u00e9\\xE2\\x98z\\xC3");
}

TEST(OddCharacters, AreNamedWithTheirPlaceAndCode) {
  EXPECT_EQ(odd_character("\u20133"), "begins with an en dash (U+2013), not a minus");
  EXPECT_EQ(odd_character("\u22123"), "begins with a minus sign (U+2212), not a hyphen-minus (-)");
  EXPECT_EQ(odd_character("3\u00a0"), "ends with a no-break space (U+00A0), not a space");
  EXPECT_EQ(odd_character("1\u00a0000"), "has a no-break space (U+00A0) in it, not a space");
  EXPECT_EQ(odd_character("siz\u200be"), "has a zero width space (U+200B) in it");
  EXPECT_EQ(odd_character("\ufeffsize"), "begins with a byte-order mark (U+FEFF)");
  EXPECT_EQ(odd_character("size\uff1a64"), "has a full-width colon (U+FF1A) in it, not a colon");
  EXPECT_EQ(odd_character("\u201c4k\u201d"),
            "begins with a curly quote (U+201C), not a straight quote");
  EXPECT_EQ(odd_character("\u3000size"), "begins with an ideographic space (U+3000), not a space");
  EXPECT_EQ(odd_character("s\u0456ze"), "has a Cyrillic letter (U+0456) in it, not one of a to z");
}

TEST(OddCharacters, OthersAreNot) {
  EXPECT_EQ(odd_character(""), "");
  EXPECT_EQ(odd_character("-3 \t\n'\":,"), "");
  EXPECT_EQ(odd_character("caf\u00e9 \u2609 \U0001f30c"), "");
  EXPECT_EQ(odd_character("caf\xe9 \xff"), "");  // no UTF-8
  EXPECT_EQ(odd_character("\u041a\u043e\u0441\u043c\u043e\u0441.png", false), "");
  EXPECT_EQ(odd_character("\u041a\u00a0.png", false),
            "has a no-break space (U+00A0) in it, not a space");
}

}  // namespace
}  // namespace domefall
