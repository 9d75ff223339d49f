// What files say of their codes, by the shipped displays.

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/grade/grader.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

using Curve = DisplayColour::Curve;

std::optional<DisplayColour> colour_of(const char* display, const char* view = "Dome") {
  GradeSettings settings;
  settings.config = source_file("shows/assets/dome.ocio");
  settings.shipped = true;
  settings.display = display;
  settings.view = view;
  return Grader(settings).colour();
}

TEST(DisplayColours, AreThoseThatTheDisplaysAreSetTo) {
  struct Known {
    const char* display;
    DisplayColour colour;
  };
  for (const Known& known : {
           Known{"Dome G2.2 Rec.709", {Curve::kPower, 2.2, kRec709Places}},
           Known{"Dome G2.4 Rec.709", {Curve::kPower, 2.4, kRec709Places}},
           Known{"Dome G2.6 P3-D65", {Curve::kPower, 2.6, kP3D65Places}},
           Known{"Dome G2.4 Rec.2020", {Curve::kPower, 2.4, kRec2020Places}},
           Known{"sRGB - Display", {Curve::kSrgb, 2.2, kRec709Places}},
       }) {
    const auto colour = colour_of(known.display);
    ASSERT_TRUE(colour) << known.display;
    EXPECT_EQ(*colour, known.colour) << known.display << ": " << colour->gamma;
  }
}

// The scene's white is adapted to the greenish white of the display, and meant to look white.
TEST(DisplayColours, OfDciP3AreSaidByTheWhiteThatTheEyeIsAdaptedTo) {
  const auto colour = colour_of("Dome G2.6 DCI-P3");
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->gamma, 2.6);
  EXPECT_NEAR(colour->xy[6], 0.3127, 2e-4);
  EXPECT_NEAR(colour->xy[7], 0.329, 2e-4);
}

TEST(DisplayColours, OfDataAreNotSaid) { EXPECT_FALSE(colour_of("Dome G2.2 Rec.709", "Raw")); }

}  // namespace
}  // namespace domefall
