// Tests of what the keys of a trajectory mean, in the units of the program.
#include "tests/pipeline/show/show_keys.h"

namespace domefall {
namespace {

TEST_F(ShowKeys, AFallEndsAtItsToR) {
  const Segment s = segment("{type: infall, from_r: 12, to_r: 3}");
  EXPECT_NEAR(point_at(s.trajectory, s.timing.tau_end).r, 3, 1e-13);
}

TEST_F(ShowKeys, RatesAreUnitsOfMPerSecondOfShow) {
  EXPECT_EQ(segment("{type: infall, from_r: 30, rate_m_per_s: 1.5}").timing.tau_end, 15);
  EXPECT_EQ(segment("{type: circular, r: 8, rate_m_per_s: 0.25}").timing.tau_end, 2.5);
  EXPECT_EQ(segment("{type: circular, r: 8}").timing.tau_end, 10)
      << "1 M per second is the default";
}

TEST_F(ShowKeys, AFallMaySlowDown) {
  EXPECT_EQ(segment("{type: infall, from_r: 12}").timing.pace, Pace::kSteady);
  EXPECT_EQ(segment("{type: infall, from_r: 12, pace: steady}").timing.pace, Pace::kSteady);
  EXPECT_EQ(segment("{type: infall, from_r: 12, pace: slowing}").timing.pace, Pace::kSlowing);
}

TEST_F(ShowKeys, OrbitsCountRevolutionsInTheSegment) {
  const Segment s = segment("{type: circular, r: 6, orbits: 1.5}");
  EXPECT_EQ(std::get<CircularOrbit>(s.trajectory).r, 6);
  EXPECT_NEAR(point_at(s.trajectory, s.timing.tau_end).azimuth, 3 * std::numbers::pi, 1e-13);
}

TEST_F(ShowKeys, TimeLapseIsRealSecondsPerSecondOfShow) {
  // One M of 4e6 suns is 4e6 * 4.925490947e-6 s = 19.701963788 s.
  EXPECT_NEAR(double(segment("{type: circular, r: 8, time_lapse: 100}").timing.tau_end),
              1000 / 19.701963788, 1e-11);
  EXPECT_NEAR(double(segment("{type: infall, from_r: 900, time_lapse: 100}").timing.tau_end),
              1000 / 19.701963788, 1e-11);
  EXPECT_NEAR(double(segment("{type: static, r: 8}").timing.tau_end), 10 / 19.701963788, 1e-13);
}

TEST_F(ShowKeys, AVelocityAgainstTheStaticFrameIsTheDefault) {
  const double rest = std::sqrt(2.0 / 6);  // gamma v of the static frame at r = 8
  expect_near(celerity("r: 8, speed: 0"), V3d(rest, 0, 0));
  // Free fall from rest at infinity moves inward at sqrt(2/r) = 1/2 against the static frame.
  expect_near(celerity("r: 8, speed: 0.5, direction: inward"), V3d(0, 0, 0));
  expect_near(celerity("r: 8, speed: 0.5, direction: inward, against: static"), V3d(0, 0, 0));
}

TEST_F(ShowKeys, DirectionsOfAVelocity) {
  const double c = 0.75;  // gamma v at v = 0.6
  const auto along = [&](const std::string& direction) {
    return celerity("r: 1, against: free_fall, speed: 0.6, direction: " + direction);
  };
  expect_near(along("inward"), V3d(-c, 0, 0));
  expect_near(along("outward"), V3d(c, 0, 0));
  expect_near(along("forward"), V3d(0, 0, c));
  expect_near(along("backward"), V3d(0, 0, -c));
  expect_near(along("north"), V3d(0, -c, 0));
  expect_near(along("south"), V3d(0, c, 0));
  expect_near(along("{radial: -3, phi: 4}"), V3d(-0.6, 0, 0.8) * c);
  expect_near(along("{theta: 2}"), V3d(0, c, 0));
  expect_near(along("{radial: 1e9, theta: 1e9, phi: 1e9}"), V3d(1, 1, 1) * (c / std::sqrt(3)));
}

TEST_F(ShowKeys, LorentzFactorsKeepTheirDigitsUpToABillion) {
  for (const auto& [text, factor] : {std::pair{"1", 1.0}, {"1.25", 1.25}, {"1e9", 1e9}}) {
    const V3d u = celerity("against: free_fall, r: 5, direction: forward, lorentz_factor: " +
                           std::string(text));
    EXPECT_NEAR(u.z / std::max(1.0, factor), std::sqrt((factor - 1) * (factor + 1)) / factor,
                1e-15);
  }
}

TEST_F(ShowKeys, InFlatSpaceAVelocityPointsToAPlaceOnTheSky) {
  const Show show = with("", "{type: velocity, speed: 0.6, direction: Vega}", "{mass_solar: 0}");
  const auto v = std::get<GivenVelocity>(show.timeline[0].trajectory);
  EXPECT_EQ(v.r, kFlatSpace);
  EXPECT_EQ(show.timeline[0].timing.tau_end, 10);
  const V3d u = celerity("speed: 0.6, direction: {ra_deg: 279.235, dec_deg: 38.784}", "{}");
  expect_near(u, v.celerity, kStarPlace);
  EXPECT_NEAR(u.length(), 0.75, 1e-14);
}

}  // namespace
}  // namespace domefall
