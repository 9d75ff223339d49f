#include "pipeline/image/utf8.h"

#include <gtest/gtest.h>

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

TEST(Utf8, BadBytesAreSpeltAndAllElseIsKept) {
  const std::string good = "/a b/\u00e9\U0001f30c\n";
  EXPECT_EQ(spell_bad_bytes(good), good);
  EXPECT_EQ(spell_bad_bytes("/a\xff/\u00e9\xe2\x98z\xc3"), "/a\\xFF/\u00e9\\xE2\\x98z\\xC3");
}

}  // namespace
}  // namespace domefall
