#include "pipeline/movie/burn_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/show/read_show.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(BurnIn, OfTheLastStableOrbitSaysHalfTheSpeedOfLight) {
  const Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  const std::string text = burn_in(show, {100, 101}, {1080, 1080});
  EXPECT_THAT(text, HasSubstr("Dialogue: 0,0:00:00.00,0:00:00.10,a,frame 100\\N0:03.333\n"));
  EXPECT_THAT(text, HasSubstr("Dialogue: 1,0:00:00.10,0:00:00.20,b,region I\\Nr = 6.0000 M\n"));
  // v = sqrt(M/(r - 2M)); light from behind and ahead: sqrt(2/3)/gamma (1 -+ v).
  EXPECT_THAT(text, HasSubstr(",d,v = 0.50000 c\\N1+z = 0.4714 to 1.4142\n"));
  EXPECT_THAT(text, HasSubstr("PlayResX: 1080\n"));
}

TEST(BurnIn, InsideTheHorizonNobodyStandsStill) {
  Show show = read_show(source_file("shows/first_light.yaml"));
  const std::string text = burn_in(show, {300}, {540, 540});  // r = 1.2 M
  EXPECT_THAT(text, HasSubstr("region II\\N"));
  EXPECT_THAT(text, HasSubstr("(free fall)"));
  EXPECT_THAT(text, Not(HasSubstr("v = 1")));
}

TEST(BurnIn, TimesGoOnAfterAnHour) {
  const Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  const std::string text = burn_in(show, std::vector<int>(36002, 0), {540, 540});
  EXPECT_THAT(text, HasSubstr("Dialogue: 0,1:00:00.10,1:00:00.20,a,frame 0\\N0:00\n"));
}

TEST(BurnIn, IsNoneOverFramesThatHaveItAsAnOverlay) {
  Show show = read_show(source_file("shows/last_stable_orbit.yaml"));
  show.overlays = {OverlayKind::kRim, OverlayKind::kBurnIn};
  EXPECT_EQ(burn_in(show, {100}, {540, 540}), "");
  show.overlays = {OverlayKind::kRim};
  EXPECT_THAT(burn_in(show, {100}, {540, 540}), HasSubstr(",a,frame 100"));
}

}  // namespace
}  // namespace domefall
