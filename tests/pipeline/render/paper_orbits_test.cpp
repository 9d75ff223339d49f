// The captions of [Riazuelo] on moving and falling observers, held against the shows of
// shows/paper/.
#include "tests/pipeline/render/paper_figures.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {
namespace {

double proper_time_between(const Show& show) {
  return frame_state(show, 1).observer.proper_time - frame_state(show, 0).observer.proper_time;
}

double degrees_between(const Show& show, int from, int to) {
  return (frame_state(show, to).observer.azimuth - frame_state(show, from).observer.azimuth) /
         kOneDegree;
}

TEST(PaperFigPar, CloseToItsPeriastronItHasTheCaptionsSpeeds) {
  const Show show = figure("figpar");
  ASSERT_EQ(frame_count(show), 3);
  const Panel near(show, 1);
  EXPECT_NEAR(near.state.observer.r, 4.02, 1e-9);
  EXPECT_LT(frame_state(show, 2).observer.r, 4.02);  // still on the way in
  EXPECT_NEAR(near.local_speed(), std::sqrt(2 / 4.02), 1e-12);
  EXPECT_NEAR(near.local_speed(), 1 / std::numbers::sqrt2, 2e-3);
  EXPECT_NEAR(near.local_speed() * std::sqrt(1 - 2 / 4.02), 0.5, 2e-4);
  // Far from the hole it is close to radial.
  const V3d ahead = Panel(show, 0).in_camera(motion_direction(frame_state(show, 0).observer));
  EXPECT_LT(angle_between(Panel(show, 0).hole(), ahead.normalized()), 10 * kOneDegree);
}

TEST(PaperFigPar, ItSweepsTheCaptions831DegreesBeforeItsPeriastron) {
  const Show show = figure("figpar");
  EXPECT_NEAR(degrees_between(show, 0, 2), 831, 0.5);
  const auto& orbit = std::get<Geodesic>(show.timeline[0].trajectory);
  EXPECT_GT(frame_state(show, 2).observer.r, orbit.innermost());
  EXPECT_LT(degrees_between(show, 0, 1), 595);
}

// The show has a third frame because no orbit has swept 831 degrees when it is at r = 4.02 M on the
// way in.
TEST(PaperFigPar, NoParabolicOrbitSweeps600DegreesBeforeItIsAt402) {
  double most = 0;
  for (const double periastron : {4.02, 4.0199, 4.019, 4.01, 4.001, 4.00001}) {
    const Geodesic orbit = parabolic_by_periastron(periastron);
    const ProperTime there = periastron == 4.02 ? 0 : *orbit.time_at(4.02, Leg::kInward);
    const ProperTime from = *orbit.time_at(1e8, Leg::kInward);
    most = std::max(most, (orbit.at(there).azimuth - orbit.at(from).azimuth) / kOneDegree);
  }
  EXPECT_GT(most, 590);
  EXPECT_LT(most, 600);
}

TEST(PaperFigHy, TheSpeedsLieJustAboveTheCaptionsBounds) {
  for (const auto& [label, periastron, km_per_s] :
       {std::tuple{"fighy1", 3.5, 141323.}, {"fighy2", 3.1, 258552.}}) {
    EXPECT_NEAR(slowest_speed_at_infinity(periastron) * kLightKmPerS, km_per_s + 0.5,
                0.5);  // cut off, not rounded
    const Show show = figure(label);
    ASSERT_EQ(frame_count(show), 2);
    const auto& orbit = std::get<Geodesic>(show.timeline[0].trajectory);
    const double e = orbit.energy(), v = std::sqrt((1 - 1 / e) * (1 + 1 / e));
    EXPECT_GT(v * kLightKmPerS, km_per_s);
    EXPECT_LT(v, slowest_speed_at_infinity(periastron) * (1 + 1e-4));
    EXPECT_GT(v, slowest_speed_at_infinity(periastron));
    EXPECT_NEAR(orbit.innermost(), periastron, 1e-9);
    // The first view has nearly that speed, the second is close to the periastron.
    EXPECT_NEAR(Panel(show, 0).local_speed(), v, 0.02);
    EXPECT_NEAR(frame_state(show, 1).observer.r, periastron, 1e-4);
  }
}

TEST(PaperFigHy, MassAndProperTimeAreThoseOfTheParabolaAndTheFirstViewsEverFarther) {
  const Show par = figure("figpar"), one = figure("fighy1"), two = figure("fighy2");
  EXPECT_NEAR(proper_time_between(one), proper_time_between(par), 1e-5);
  EXPECT_NEAR(proper_time_between(two), proper_time_between(par), 1e-5);
  EXPECT_EQ(one.spacetime.solar_masses(), par.spacetime.solar_masses());
  EXPECT_EQ(two.spacetime.solar_masses(), par.spacetime.solar_masses());
  const auto start = [](const Show& show) { return frame_state(show, 0).observer.r; };
  EXPECT_LT(start(par), start(one));
  EXPECT_LT(start(one), start(two));
}

TEST(PaperLsoPlane, TheMotionStandsAtPixel2000And3000AtHalfTheSpeedOfLight) {
  const Panel panel(figure("LSO_plane"), 0);
  EXPECT_EQ(panel.state.observer.r, 6);
  EXPECT_NEAR(panel.local_speed(), 0.5, 1e-14);
  const V3d ahead = panel.in_camera(motion_direction(panel.state.observer).normalized());
  const auto p = pixel_of(Domemaster{4000}, {ahead});
  ASSERT_TRUE(p);
  EXPECT_EQ(std::floor(p->i), 2000);
  EXPECT_EQ(std::floor(p->j), 3000);
}

// ---- through the horizon ----

TEST(PaperFigHor, JustBeforeJustBehindAndAtATenth) {
  const Show show = figure("fighor");
  ASSERT_EQ(frame_count(show), 3);
  const Panel before(show, 0), behind(show, 1), last(show, 2);
  EXPECT_GT(before.state.observer.r, 2);
  EXPECT_LT(before.state.observer.r, 2.02);
  EXPECT_LT(behind.state.observer.r, 2);
  EXPECT_GT(behind.state.observer.r, 1.98);
  EXPECT_NEAR(last.state.observer.r, 0.1, 1e-12);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(frame_state(show, k).observer.celerity, V3d(0, 0, 0));
  // Nothing shows that the horizon is crossed: the silhouette has the same size to a percent.
  const auto edge = [](const Panel& panel) {
    double in = 0.5, out = 1;
    for (int k = 0; k < 50; ++k)
      (panel.trace((in + out) / 2, 0.5).sky == SkyRegion::kI ? out : in) = (in + out) / 2;
    return in - 0.5;
  };
  EXPECT_NEAR(edge(before) / edge(behind), 1, 0.01);
  // The redshift is z = -cos(delta) sqrt(2/r), which is 0 to the side.
  EXPECT_NEAR(last.z(0.5, 0.5), 0, 1e-12);
  EXPECT_TRUE(std::holds_alternative<GridSky>(show.sky[SkyRegion::kIII].background));
  EXPECT_EQ(last.trace(0.9, 0.5).sky, SkyRegion::kIII);
  EXPECT_EQ(last.state.settings.sky[SkyRegion::kI].background_gain, 0);
  EXPECT_EQ(behind.state.settings.sky[SkyRegion::kIII].background_gain, 0);
}

TEST(PaperFigHor2, TheLastViewHasTheSkyOfFigHorToTheRightAndAnotherToTheLeft) {
  const Show show = figure("fighor2"), single = figure("fighor");
  ASSERT_EQ(frame_count(show), 3);
  EXPECT_NEAR(frame_state(show, 0).observer.r, 1.994, 1e-12);
  EXPECT_NEAR(frame_state(show, 1).observer.r, 0.8, 1e-12);
  EXPECT_NEAR(frame_state(show, 2).observer.r, 0.1, 1e-12);
  const Panel point(show, 0), disc(show, 1), both(show, 2), same(single, 2);
  // Region III is seen ahead at 1 + z = sqrt(2/r) - 1.
  EXPECT_EQ(point.trace(0.5, 0.5).sky, SkyRegion::kIII);
  EXPECT_EQ(point.trace(0.51, 0.5).sky, SkyRegion::kIV);  // almost pointlike
  EXPECT_NEAR(1 + point.z(0.5, 0.5), std::sqrt(2 / 1.994) - 1, 1e-12);
  EXPECT_NEAR(1 + disc.z(0.5, 0.5), std::sqrt(2 / 0.8) - 1, 1e-12);
  EXPECT_EQ(disc.trace(0.7, 0.5).sky, SkyRegion::kIII);
  EXPECT_LT(disc.z(0.7, 0.5), disc.z(0.5, 0.5));  // its edge is bluer than its middle
  EXPECT_EQ(both.trace(0.1, 0.5).sky, SkyRegion::kIII);
  for (const double x : {0.6, 0.8, 0.95})
    for (const double y : {0.1, 0.5, 0.9}) {
      const ViewRay a = both.trace(x, y), b = same.trace(x, y);
      EXPECT_EQ(a.sky, SkyRegion::kI);
      EXPECT_NEAR(a.frequency_ratio, b.frequency_ratio, 1e-12);
      EXPECT_LT((a.sky_direction - b.sky_direction).length(), 1e-9);
    }
}

// ---- the past singularity ----

TEST(PaperFigWh, FromOutsideAndFromTheMiddle) {
  const Show one = figure("fig_wh_1"), two = figure("fig_wh_2");
  EXPECT_EQ(frame_state(one, 0).observer.r, 20);
  EXPECT_NEAR(Panel(one, 0).local_speed(), 0, 1e-7);
  EXPECT_EQ(Panel(one, 0).trace(0.5, 0.5).sky, SkyRegion::kIV);
  EXPECT_TRUE(std::holds_alternative<GridSky>(one.sky[SkyRegion::kIV].background));
  EXPECT_FALSE(std::holds_alternative<GridSky>(one.sky[SkyRegion::kI].background));
  const Panel inside(two, 0);
  EXPECT_EQ(inside.state.observer.r, 1);
  EXPECT_NEAR(angle_between(inside.hole(), V3d(0, 0, 1)), 45 * kOneDegree, 1e-12);
  EXPECT_EQ(inside.trace(0.9, 0.5).sky, SkyRegion::kI);
  EXPECT_EQ(inside.trace(0.2, 0.5).sky, SkyRegion::kIII);
}

TEST(PaperFigIv, TheOutgoingObserverPassesTheOneOfFigIvImgAtSqrtOfHalfR) {
  const Show resting = figure("fig_IV_img"), leaving = figure("fig_IV_last_img");
  ASSERT_EQ(frame_count(resting), 4);
  ASSERT_EQ(frame_count(leaving), 4);
  const double r[] = {0.001, 0.2, 1.7, 1.998};
  for (int k = 0; k < 4; ++k) {
    const ObserverState rest = frame_state(resting, k).observer,
                        leave = frame_state(leaving, k).observer;
    EXPECT_EQ(rest.region, Region::kIV);
    EXPECT_EQ(leave.region, Region::kIV);
    EXPECT_NEAR(rest.r, r[k], 1e-12);
    EXPECT_NEAR(leave.r, r[2 + k / 2], 1e-12);
    EXPECT_EQ(leave.celerity, V3d(0, 0, 0));
    // The speed against the outgoing frame is that against the other observer, who is at rest
    // there.
    const double speed = rest.celerity.length() / std::sqrt(1 + rest.celerity.dot(rest.celerity));
    EXPECT_NEAR(speed, std::sqrt(r[k] / 2), 1e-12);
    // Frames of the left column face backwards on the flight out, those of the right column
    // forwards.
    const V3d middle = column(leave.tetrad_from_camera, 2);
    EXPECT_NEAR(middle.x, k % 2 == 0 ? -1 : 1, 1e-12);
  }
}

}  // namespace
}  // namespace domefall
