#include "pipeline/image/encode/display_colour.h"

#include <gtest/gtest.h>
#include <lcms2.h>

#include <cmath>
#include <map>

#include "pipeline/image/digest.h"

namespace domefall {
namespace {

using Curve = DisplayColour::Curve;
constexpr DisplayColour kDome22{Curve::kPower, 2.2, kRec709Places},
    kCinema{Curve::kPower, 2.6, kP3D65Places}, kScreen{Curve::kSrgb, 2.2, kRec709Places};

std::map<std::string, std::string> chunks_of(const DisplayColour& colour) {
  std::map<std::string, std::string> chunks;
  for (const PngChunk& chunk : png_colour_chunks(colour))
    chunks[std::string(chunk.name)] = chunk.data;
  return chunks;
}

unsigned number_at(const std::string& bytes, std::size_t k = 0) {
  unsigned value = 0;
  for (std::size_t at = 4 * k; at < 4 * k + 4; ++at)
    value = value << 8 | static_cast<unsigned char>(bytes[at]);
  return value;
}

TEST(DisplayColourChunks, SayThePowerOfADomeAndNotSrgb) {
  auto chunks = chunks_of(kDome22);
  EXPECT_EQ(number_at(chunks["gAMA"]), 45455U);
  EXPECT_EQ(number_at(chunks["cHRM"], 0), 31270U);  // the white comes first
  EXPECT_EQ(number_at(chunks["cHRM"], 2), 64000U);
  EXPECT_FALSE(chunks.contains("sRGB"));
}

TEST(DisplayColourChunks, SayThePowerAndThePrimariesOfACinema) {
  auto chunks = chunks_of(kCinema);
  EXPECT_FALSE(chunks.contains("sRGB"));
  EXPECT_EQ(number_at(chunks["gAMA"]), 38462U);
  EXPECT_EQ(number_at(chunks["cHRM"], 2), 68000U);
}

TEST(DisplayColourChunks, SaySrgbOfSrgbAlone) {
  auto chunks = chunks_of(kScreen);
  EXPECT_EQ(chunks["sRGB"], std::string(1, '\0'));
}

// As another program converts codes by it: to the light of the display.
TEST(IccProfiles, TakeCodesToTheLightOfTheDisplay) {
  for (const DisplayColour& colour : {kDome22, kCinema, kScreen}) {
    const std::string bytes = icc_profile(colour);
    const auto profile = cmsOpenProfileFromMem(bytes.data(), static_cast<unsigned>(bytes.size()));
    ASSERT_TRUE(profile);
    const auto xyz = cmsCreateXYZProfile();
    const auto transform = cmsCreateTransform(profile, TYPE_RGB_DBL, xyz, TYPE_XYZ_DBL,
                                              INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOOPTIMIZE);
    ASSERT_TRUE(transform);
    for (const double code : {0.02, 0.1, 0.5, 0.9}) {
      const double grey[] = {code, code, code};
      double light[3] = {};
      cmsDoTransform(transform, grey, light, 1);
      const double wanted = colour.curve == Curve::kPower ? std::pow(code, colour.gamma)
                            : code <= 0.04045             ? code / 12.92
                                                          : std::pow((code + 0.055) / 1.055, 2.4);
      EXPECT_NEAR(light[1], wanted, 1e-4) << code;
    }
    cmsDeleteTransform(transform);
    cmsCloseProfile(xyz);
    cmsCloseProfile(profile);
  }
}

TEST(IccProfiles, HaveNoMomentOfTheirMaking) {
  const std::string bytes = icc_profile(kDome22);
  EXPECT_EQ(bytes.substr(24, 12), std::string("\x07\xb2\0\x01\0\x01\0\0\0\0\0\0", 12));
  EXPECT_EQ(bytes, icc_profile(kDome22));
}

}  // namespace
}  // namespace domefall
