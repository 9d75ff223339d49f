#include "pipeline/movie/colour_tags.h"

#include <gtest/gtest.h>

#include <string>

#include "pipeline/grade/grader.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

// The tags of codes of the shipped configuration.
ColourTags tags_for(const std::string& display, const std::string& view = "") {
  GradeSettings settings;
  settings.config = source_file("shows/assets/dome.ocio");
  settings.shipped = true;
  settings.display = display;
  settings.view = view;
  return tags_of(Grader(settings).colour());
}

TEST(ColourTags, OfTheShippedDisplaysAreWhatTheirNamesSay) {
  EXPECT_EQ(tags_for("Dome G2.2 Rec.709"), (ColourTags{1, 4, 1}));
  EXPECT_EQ(tags_for("Dome G2.4 Rec.709"), (ColourTags{1, 1, 1}));
  EXPECT_EQ(tags_for("Rec.1886 Rec.709 - Display"), (ColourTags{1, 1, 1}));
  EXPECT_EQ(tags_for("sRGB - Display"), (ColourTags{1, 13, 1}));
  EXPECT_EQ(tags_for("Dome G2.4 Rec.2020"), (ColourTags{9, 14, 9}));
}

TEST(ColourTags, APowerOf26HasNoTagButItsPrimariesHave) {
  EXPECT_EQ(tags_for("Dome G2.6 P3-D65"), (ColourTags{12, 2, 1}));
  EXPECT_EQ(tags_for("Dome G2.6 DCI-P3"), (ColourTags{11, 2, 1}));
}

TEST(ColourTags, EveryViewOfADisplayHasTheSame) {
  for (const char* view : {"Dome", "ACES SDR", "Star field", "Un-tone-mapped"})
    EXPECT_EQ(tags_for("sRGB - Display", view), (ColourTags{1, 13, 1})) << view;
}

TEST(ColourTags, CodesOfNoDisplayHaveNone) {
  EXPECT_EQ(tags_for("sRGB - Display", "Raw"), (ColourTags{2, 2, 1}));
}

TEST(ColourTags, SayWhatTheyAre) {
  EXPECT_EQ(describe({12, 4, 1}),
            "primaries smpte432 (P3-D65), transfer bt470m (gamma 2.2), matrix bt709");
  EXPECT_EQ(describe({2, 2, 1}), "primaries unspecified, transfer unspecified, matrix bt709");
}

}  // namespace
}  // namespace domefall
