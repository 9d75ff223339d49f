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

}  // namespace
}  // namespace domefall
