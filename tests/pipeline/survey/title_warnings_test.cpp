#include "pipeline/survey/title_warnings.h"

#include <gmock/gmock.h>

#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Warnings of a title in a dome of 256 pixels, of which each is 0.7 degrees, at 10 frames a second.
class TitleWarnings : public ShowFile {
 protected:
  std::vector<std::string> texts(const std::string& title, const std::string& of_segment = "") {
    const Show show = read("frames_per_second: 10\nsize: 256\ntitles: [{" + title +
                           "}]\ntimeline: [{duration_s: 2" + of_segment + "}]\n");
    std::vector<std::string> all;
    for (const ShowWarning& w : title_warnings(show)) all.push_back(w.text);
    return all;
  }
};

TEST_F(TitleWarnings, AreNoneOfATitleThatIsSeen) {
  EXPECT_THAT(texts("text: Vega, height_deg: 3"), IsEmpty());
}

TEST_F(TitleWarnings, AreOfATitleBetweenTwoFrames) {
  const auto lost = HasSubstr("is seen in no frame");
  const auto at = [&](const std::string& times) {
    return texts("text: Vega, height_deg: 3, " + times);
  };
  EXPECT_THAT(at("at_s: 0.51, duration_s: 0.08"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 0.57, duration_s: 0.02"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 0.51, duration_s: 0.1"), IsEmpty());
  EXPECT_THAT(at("at_s: 0.5, duration_s: 0.02"), IsEmpty());
  EXPECT_THAT(at("at_s: 0.3, duration_s: 0.02"), IsEmpty());
  // The show's last frame stands a tenth of a second before its end.
  EXPECT_THAT(at("at_s: 1.95"), ElementsAre(lost));
  EXPECT_THAT(at("at_s: 1.9"), IsEmpty());
  // Its one frame would have it at the dark end of a fade.
  EXPECT_THAT(texts("text: Vega, height_deg: 3, at_s: 0.5, duration_s: 0.08, fade_in_s: 0.04"),
              ElementsAre(lost));
}

TEST_F(TitleWarnings, AreOfATitleWithoutInk) {
  const auto nothing = HasSubstr("writes nothing");
  EXPECT_THAT(texts("text: \"\\u00A0\", height_deg: 3"), ElementsAre(nothing));
  EXPECT_THAT(texts("text: \"\\u3000\\u200B\", height_deg: 3"), ElementsAre(nothing));
  EXPECT_THAT(texts("text: \"a\\u00A0\", height_deg: 3"), IsEmpty());
}

TEST_F(TitleWarnings, AreOfCapitalsOfTwoPixels) {
  const auto small = HasSubstr("they have 2 with a height_deg of 1.41");
  EXPECT_THAT(texts("text: Vega, height_deg: 1.35"), ElementsAre(small));
  EXPECT_THAT(texts("text: Vega, height_deg: 0.7"),
              ElementsAre(HasSubstr("the title 'Vega' has capitals lower than 2 pixels")));
  EXPECT_THAT(texts("text: Vega, height_deg: 1.45"), IsEmpty());
  EXPECT_THAT(texts("text: Vega, height_deg: 3", ", titles: [{text: Deneb, height_deg: 0.5}]"),
              ElementsAre(small));
}

TEST_F(TitleWarnings, AreOfATitleThatRunsIntoItself) {
  EXPECT_THAT(texts("text: " + std::string(150, 'M') + ", height_deg: 5"),
              Contains(HasSubstr("a smaller height_deg or more lines would fit")));
}

}  // namespace
}  // namespace domefall
