#include "pipeline/grade/dome_light.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "pipeline/grade/grader.h"
#include "projections/projection.h"
#include "tests/pipeline/image/test_folder.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

using Light = DomeSettings::Light;

// A display whose channels have this power, each with a white of its own.
DomeLight::Curves power_curves(double power) {
  DomeLight::Curves curves;
  const double whites[3]{0.2, 0.7, 0.1};
  for (std::size_t c = 0; c < 3; ++c)
    for (int code = 0; code < kCodes; ++code)
      curves[c].push_back(whites[c] * std::pow(code / (kCodes - 1.0), power));
  return curves;
}

// Changes a whole domemaster.
void change_dome(const DomeLight& light, GradedFrame& frame) {
  DomeCodes dome;
  dome.add_rows(frame, 0, frame.height);
  light.map_for(dome).change_rows(frame, 0, frame.height);
}

// A dome whose codes lie evenly between the bounds, and a tenth of which has twice as much.
GradedFrame random_dome(int size, unsigned seed, int least, int most) {
  std::mt19937 random(seed);
  GradedFrame frame(size, size);
  const auto range = static_cast<unsigned>(most - least + 1);
  for (int y = 0; y < size; ++y) {
    const ColumnRange inside = inside_columns(Domemaster{size}, y);
    for (int k = 3 * inside.first; k < 3 * inside.last + 3; ++k) {
      const unsigned code = static_cast<unsigned>(least) + static_cast<unsigned>(random()) % range;
      frame.row(y)[k] = static_cast<unsigned short>(random() % 10 == 0 ? 2 * code : code);
    }
  }
  return frame;
}

struct Patch {
  Imath::V3d at, beside;  // unit vectors: its middle, and a point near its rim
  double area = 0;        // of a dome of radius 1
  std::size_t pixel = 0;
};

std::vector<Patch> patches_of(int size) {
  const Domemaster dome{size};
  std::vector<Patch> patches;
  for (int y = 0; y < size; ++y) {
    const ColumnRange inside = inside_columns(dome, y);
    for (int x = inside.first; x <= inside.last; ++x)
      patches.push_back({direction_at(dome, {x + 1.0, y + 1.0}).v,
                         direction_at(dome, {x + 1.3, y + 0.8}).v,
                         pixel_solid_angle(dome, {x + 1.0, y + 1.0}),
                         static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                             static_cast<std::size_t>(x)});
  }
  // Pixels at the rim stick out, so that all are made a little smaller to cover the dome once.
  double whole = 0;
  for (const Patch& p : patches) whole += p.area;
  for (Patch& p : patches) p.area *= 2 * std::numbers::pi / whole;
  return patches;
}

// The part of the light of `from` that arrives at `to`, per its area: cos a cos b dA/(pi d^2).  A
// patch is seen from a point beside its middle, so that it also throws light upon itself.
double form_factor(const Patch& from, const Patch& to) {
  const Imath::V3d way = to.beside - from.at;
  const double d = way.length();
  const double cos_from = -(way ^ from.at) / d, cos_to = (way ^ to.beside) / d;
  return cos_from * cos_to * from.area / (std::numbers::pi * d * d);
}

// The light of each patch after many bounces, summed over pairs of patches.
std::vector<double> bounced(const std::vector<Patch>& patches, const std::vector<double>& own,
                            double reflectance) {
  std::vector<double> light = own;
  for (int bounce = 0; bounce < 25; ++bounce) {
    std::vector<double> next = own;
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (std::size_t j = 0; j < patches.size(); ++j)
        next[i] += reflectance * light[j] * form_factor(patches[j], patches[i]);
    light = next;
  }
  return light;
}

// A code's rounding is below 2e-4 of what is added.
TEST(DomeLightSimulation, IsTheSumOverAllPairsOfPatches) {
  constexpr int kSize = 17;
  const std::vector<Patch> patches = patches_of(kSize);
  const DomeLight::Curves curves = power_curves(1);
  for (const unsigned seed : {1u, 2u, 3u}) {
    const double reflectance = 0.25 * seed;
    GradedFrame frame = random_dome(kSize, seed, 0, 9000);
    // One side of the dome is brighter, which must not matter.
    for (int y = 0; y < kSize / 2; ++y)
      for (int k = 0; k < 3 * kSize; ++k) frame.row(y)[k] /= 4;
    std::vector<double> own;
    for (const Patch& p : patches) own.push_back(curves[1][frame.pixels[3 * p.pixel + 1]]);
    const std::vector<double> expected = bounced(patches, own, reflectance);
    change_dome(DomeLight({Light::kSimulate, reflectance}, curves), frame);
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const double added = curves[1][frame.pixels[3 * patches[k].pixel + 1]] - own[k];
      ASSERT_NEAR(added, expected[k] - own[k], 0.001 * (expected[k] - own[k])) << seed << ' ' << k;
    }
  }
}

TEST(DomeLightSimulation, AddsAThirdOfAnEvenDomesLightAtAReflectanceOfOneHalf) {
  GradedFrame frame(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int k = 0; k < 3 * 64; ++k) frame.row(y)[k] = 30000;
  change_dome(DomeLight({Light::kSimulate, 0.5}, power_curves(1)), frame);
  EXPECT_EQ(frame.row(32)[96], 40000);
  EXPECT_EQ(frame.row(0)[0], 30000) << "a corner is no part of the dome";
}

TEST(DomeCodes, WeighPixelsByTheirAreaOnTheDome) {
  constexpr int kSize = 200;
  const Domemaster dome{kSize};
  GradedFrame frame(kSize, kSize);
  unsigned short code = 0;
  std::vector<double> areas;
  for (const int y : {0, 3, 50, 99, 199}) {
    const ColumnRange inside = inside_columns(dome, y);
    for (int x = inside.first; x <= inside.last; ++x) {
      frame.row(y)[3 * x + 2] = ++code;
      areas.push_back(pixel_solid_angle(dome, {x + 1.0, y + 1.0}));
    }
  }
  DomeCodes codes;
  codes.add_rows(frame, 0, kSize);
  double whole = 0;
  for (int y = 0; y < kSize; ++y) {
    const ColumnRange inside = inside_columns(dome, y);
    for (int x = inside.first; x <= inside.last; ++x)
      whole += pixel_solid_angle(dome, {x + 1.0, y + 1.0});
  }
  const double unit = whole / static_cast<double>(codes.whole());
  for (std::size_t k = 0; k < areas.size(); ++k)
    ASSERT_NEAR(static_cast<double>(codes.area(2, static_cast<int>(k) + 1)) * unit / areas[k], 1,
                1e-5);
}

// A code is half a step off after each of two roundings.
TEST(DomeLightCompensation, GivesThePictureBackInTheDome) {
  for (const double power : {1.0, 2.2}) {
    const DomeLight::Curves curves = power_curves(power);
    const GradedFrame picture = random_dome(60, 7, 25000, 32000);
    GradedFrame frame = picture;
    change_dome(DomeLight({Light::kCompensate, 0.45}, curves), frame);
    EXPECT_LT(frame.row(30)[90], picture.row(30)[90]);
    change_dome(DomeLight({Light::kSimulate, 0.45}, curves), frame);
    for (std::size_t k = 0; k < frame.pixels.size(); ++k)
      ASSERT_LE(std::abs(frame.pixels[k] - picture.pixels[k]), 1) << power << ' ' << k;
  }
}

// What can be had is had: in the dome no pixel is too dark, and none that is not black too bright.
TEST(DomeLightCompensation, EndsAtBlackAndIsRightElsewhere) {
  const DomeLight::Curves curves = power_curves(2.2);
  const GradedFrame picture = random_dome(60, 11, 0, 32000);
  GradedFrame sent = picture;
  change_dome(DomeLight({Light::kCompensate, 0.45}, curves), sent);
  GradedFrame seen = sent;
  change_dome(DomeLight({Light::kSimulate, 0.45}, curves), seen);
  int black = 0;
  for (std::size_t k = 0; k < seen.pixels.size(); ++k) {
    ASSERT_LE(sent.pixels[k], picture.pixels[k]);
    ASSERT_GE(seen.pixels[k], picture.pixels[k] - 1);
    if (sent.pixels[k] > 0) {
      ASSERT_LE(seen.pixels[k], picture.pixels[k] + 1);
    }
    black += sent.pixels[k] == 0 && picture.pixels[k] > 0;
  }
  EXPECT_GT(black, 500) << "the picture has something to cut";
}

TEST(DomeLight, LeavesABlackDomeAndAMatBlackDomeAsTheyAre) {
  for (const Light light : {Light::kSimulate, Light::kCompensate}) {
    GradedFrame black(40, 40);
    change_dome(DomeLight({light, 0.45}, power_curves(2.2)), black);
    EXPECT_EQ(black.pixels, GradedFrame(40, 40).pixels);
    const GradedFrame picture = random_dome(40, 5, 0, 32000);
    GradedFrame mat = picture;
    change_dome(DomeLight({light, 0}, power_curves(2.2)), mat);
    EXPECT_EQ(mat.pixels, picture.pixels);
  }
}

TEST(DomeCodes, AreTheSameForAnySplitIntoRows) {
  const GradedFrame frame = random_dome(51, 3, 0, 32000);
  DomeCodes whole, lower, upper;
  whole.add_rows(frame, 0, 51);
  lower.add_rows(frame, 20, 51);
  upper.add_rows(frame, 0, 20);
  lower.add(upper);
  EXPECT_EQ(lower.whole(), whole.whole());
  for (int c = 0; c < 3; ++c)
    for (int code = 0; code < kCodes; ++code)
      ASSERT_EQ(lower.area(c, code), whole.area(c, code)) << c << ' ' << code;
}

// ---- the displays of configurations ----

GradeSettings shipped_for(Light light, const std::string& display, const std::string& view = "") {
  GradeSettings settings{.config = source_file("shows/assets/dome.ocio"),
                         .shipped = true,
                         .display = display,
                         .view = view};
  settings.dome.light = light;
  return settings;
}

// An even dome of code v has afterwards the code of (1 + k) times its light: for a pure power that
// is v (1 + k)^(1/power).
TEST(DomeLight, FollowsThePowerOfTheDisplay) {
  const double k = bounced_part(0.45);
  for (const auto& [display, power] : {std::pair{"Dome G2.2 Rec.709", 2.2},
                                       {"Dome G2.4 Rec.709", 2.4},
                                       {"Dome G2.6 P3-D65", 2.6},
                                       {"Dome G2.6 DCI-P3", 2.6}}) {
    const Grader grader(shipped_for(Light::kSimulate, display));
    GradedFrame even(16, 16);
    std::fill(even.pixels.begin(), even.pixels.end(), static_cast<unsigned short>(20000));
    ASSERT_TRUE(grader.dome_light());
    change_dome(*grader.dome_light(), even);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(even.row(8)[24 + c], 20000 * std::pow(1 + k, 1 / power), 2) << display;
  }
}

TEST(DomeLight, CanBeHadWithAllDisplaysThatAreShipped) {
  for (const char* display : {"Dome G2.4 Rec.2020", "sRGB - Display", "Rec.1886 Rec.709 - Display"})
    EXPECT_TRUE(Grader(shipped_for(Light::kCompensate, display)).dome_light()) << display;
}

TEST(DomeLight, IsAPartOfTheGradesName) {
  const auto id = [](Light light, double reflectance) {
    GradeSettings settings = shipped_for(light, "Dome G2.2 Rec.709");
    settings.dome.reflectance = reflectance;
    return Grader(settings).transform_id();
  };
  EXPECT_EQ(id(Light::kNone, 0.45), id(Light::kNone, 0.3)) << "nothing is done in either";
  EXPECT_NE(id(Light::kNone, 0.45), id(Light::kSimulate, 0.45));
  EXPECT_NE(id(Light::kCompensate, 0.45), id(Light::kSimulate, 0.45));
  EXPECT_NE(id(Light::kCompensate, 0.45), id(Light::kCompensate, 0.3));
}

TEST(DomeLight, NeedsAViewWhoseCodesAreADisplays) {
  EXPECT_THAT(
      message_of([] { Grader(shipped_for(Light::kSimulate, "Dome G2.2 Rec.709", "Raw")); }),
      testing::HasSubstr(
          "dome.light cannot be had with the view 'Raw' of the display 'Dome G2.2 Rec.709', "
          "whose codes are not in the colour space of a display"));
}

}  // namespace
}  // namespace domefall
