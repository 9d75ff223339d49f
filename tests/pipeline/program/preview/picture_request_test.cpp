#include "pipeline/program/preview/picture_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "pipeline/program/preview/page_files.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using testing::HasSubstr;

Show two_seconds() {
  Show show;
  Segment segment;
  segment.duration_s = 2;
  show.timeline = {segment};
  return show;
}

PictureRequest asked(const std::map<std::string, std::string, std::less<>>& given) {
  const Parameters parameters = [&](std::string_view name) -> std::optional<std::string> {
    const auto found = given.find(name);
    if (found == given.end()) return std::nullopt;
    return found->second;
  };
  return read_request(parameters, two_seconds());
}

std::string refusal(const std::map<std::string, std::string, std::less<>>& given) {
  return message_of([&] { asked(given); });
}

TEST(PreviewPage, OffersEachProjectionThatIsOneImage) {
  const auto file = std::ranges::find(page_files(), "projections.js", &PageFile::name);
  ASSERT_NE(file, page_files().end());
  for (const ProjectionTraits& traits : kEveryProjectionTraits) {
    const std::string entry = "\n  " + std::string(traits.name) + ": {";
    EXPECT_EQ(file->bytes.find(entry) != std::string_view::npos, !traits.has_faces) << entry;
  }
}

TEST(PictureRequest, IsThatOfTheShowWhereNothingIsSaid) {
  const PictureRequest request = asked({});
  EXPECT_EQ(request.frame, 0);
  EXPECT_FALSE(request.look);
  EXPECT_FALSE(request.effects);
  EXPECT_FALSE(request.moving);
  EXPECT_TRUE(request.stars);
  EXPECT_EQ(request.ev, 0);
  for (const SkyRegion sky : kEverySky) EXPECT_TRUE(request.skies[sky]);
  EXPECT_NEAR(*field_of_view(request.projection), 100 * std::numbers::pi / 180, 1e-12);
}

TEST(PictureRequest, SaysAllThatAClientMayWish) {
  const PictureRequest request = asked({{"frame", "31"},
                                        {"w", "640"},
                                        {"h", "360"},
                                        {"projection", "rectilinear"},
                                        {"fov", "70"},
                                        {"look", "-20,30.5,1e1"},
                                        {"ev", "-1.5"},
                                        {"effects", "lensing,intensity"},
                                        {"amplification", "none"},
                                        {"skies", "III"},
                                        {"stars", "0"},
                                        {"overlays", "rim,grid"},
                                        {"detail", "moving"}});
  EXPECT_EQ(request.frame, 31);
  EXPECT_EQ(columns(request.projection), 640);
  EXPECT_EQ(rows(request.projection), 360);
  EXPECT_EQ(projection_name(request.projection), "rectilinear");
  ASSERT_TRUE(request.look);
  EXPECT_EQ(request.look->azimuth_deg, -20);
  EXPECT_EQ(request.look->altitude_deg, 30.5);
  EXPECT_EQ(request.look->roll_deg, 10);
  ASSERT_TRUE(request.effects);
  EXPECT_TRUE(request.effects->lensing && request.effects->intensity);
  EXPECT_FALSE(request.effects->aberration || request.effects->doppler_colour);
  EXPECT_EQ(request.effects->amplification, Amplification::kNone);
  EXPECT_FALSE(request.skies[SkyRegion::kI] || request.skies[SkyRegion::kIV]);
  EXPECT_TRUE(request.skies[SkyRegion::kIII]);
  EXPECT_FALSE(request.stars);
  EXPECT_EQ(request.overlays.size(), 2);
  EXPECT_TRUE(request.moving);
}

TEST(PictureRequest, BeyondTheEndShowsTheEnd) { EXPECT_EQ(asked({{"frame", "900"}}).frame, 59); }

TEST(PictureRequest, IsRefusedWithTheNameAndTheBound) {
  for (const auto& [name, value] :
       std::multimap<std::string, std::string>{{"frame", "-1"},
                                               {"frame", "1e18"},
                                               {"frame", "99999999999999"},
                                               {"w", "15"},
                                               {"h", "4097"},
                                               {"fov", "0"},
                                               {"fov", "nan"},
                                               {"ev", "inf"},
                                               {"ev", "1 "},
                                               {"stars", ""},
                                               {"look", "1,2"},
                                               {"look", "1,2,x"},
                                               {"look", "1,2,9999"}})
    EXPECT_THAT(refusal({{name, value}}), HasSubstr(name + " must be")) << value;
  EXPECT_THAT(refusal({{"projection", "flat"}}), HasSubstr("projection has no 'flat'; it has"));
  EXPECT_THAT(refusal({{"skies", "II"}}), HasSubstr("skies has no 'II'"));
  EXPECT_THAT(refusal({{"effects", "magic"}}), HasSubstr("effects has no 'magic'"));
  EXPECT_THAT(refusal({{"overlays", "gird"}}), HasSubstr("grid"));
  EXPECT_THAT(refusal({{"detail", "fine"}}), HasSubstr("detail has no 'fine'"));
}

}  // namespace
}  // namespace domefall
