#include "pipeline/base/lettering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <vector>

namespace domefall {
namespace {

struct Box {
  double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
};

Box box_of(const LetteredText& text) {
  Box box;
  const auto add = [&box](const TextPoint& p) {
    box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
    box.bottom = std::min(box.bottom, p.y), box.top = std::max(box.top, p.y);
  };
  for (const TextOutline& outline : text.outlines) {
    add(outline.start);
    for (const TextCurve& curve : outline.curves) add(curve.end);
  }
  return box;
}

TEST(Lettering, CountsInCapitalsAboutTheMiddle) {
  for (const char* font : {"DejaVu Sans", "DejaVu Sans Mono Bold"}) {
    const LetteredText text = lettered("H", {font});
    ASSERT_EQ(text.outlines.size(), 1u) << font;
    EXPECT_TRUE(text.font_found) << font;
    EXPECT_EQ(text.missing, 0);
    // Cairo rounds to 1/256 of a unit, of which a capital has some 730.
    const Box box = box_of(text);
    EXPECT_NEAR(box.top, 0.5, 1e-5) << font;
    EXPECT_NEAR(box.bottom, -0.5, 1e-5) << font;
    EXPECT_NEAR(text.half_height, 0.5, 1e-5) << font;
    // Its sides have room to its neighbours.
    EXPECT_LT(box.right, text.half_width) << font;
    EXPECT_NEAR(box.left, -box.right, 0.02) << font;
  }
}

TEST(Lettering, AlignsLinesOfDifferentLengths) {
  const auto ends = [](TextAlign align) {
    const LetteredText text = lettered("HHHHHHHH\nH", {"DejaVu Sans", align});
    EXPECT_GT(text.half_height, 1);
    Box lower;  // of the second line
    for (const TextOutline& outline : text.outlines)
      if (outline.start.y < 0)
        for (const TextCurve& curve : outline.curves)
          lower.left = std::min(lower.left, curve.end.x),
          lower.right = std::max(lower.right, curve.end.x);
    return std::pair{lower.left + text.half_width, text.half_width - lower.right};
  };
  const auto left = ends(TextAlign::kLeft), centre = ends(TextAlign::kCentre),
             right = ends(TextAlign::kRight);
  EXPECT_LT(left.first, 0.3);
  EXPECT_GT(left.second, 5);
  EXPECT_NEAR(centre.first, centre.second, 0.02);
  EXPECT_GT(right.first, 5);
  EXPECT_LT(right.second, 0.3);
}

TEST(Lettering, WritesOtherScriptsAndCountsWhatNoFontHas) {
  for (const char* text : {"Ἀστὴρ μέλας", "Чёрная дыра", "Trou noir, à l’œil nu"})
    EXPECT_EQ(lettered(text, {}).missing, 0) << text;
  // Two code points for private use, and a byte that is no UTF-8.
  EXPECT_EQ(lettered("a\U0010FF00\U0010FF01", {}).missing, 2);
  EXPECT_FALSE(lettered("a\xff", {}).outlines.empty());
}

TEST(Lettering, AnotherFontStandsInForOneThatIsNotThere) {
  const LetteredText text = lettered("H", {"No Such Font Was Ever Cast"});
  EXPECT_FALSE(text.font_found);
  EXPECT_FALSE(text.outlines.empty());
  EXPECT_TRUE(lettered("H", {"sans"}).font_found);
}

TEST(Lettering, IsTheSameFromAnyThread) {
  const auto letters = [] { return box_of(lettered("Vega & Ἄλκωρ", {})).right; };
  const double alone = letters();
  std::vector<std::future<double>> others;
  for (int k = 0; k < 4; ++k) others.push_back(std::async(std::launch::async, letters));
  for (auto& other : others) EXPECT_EQ(other.get(), alone);
}

}  // namespace
}  // namespace domefall
