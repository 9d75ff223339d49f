#include "pipeline/render/rays/sky_borders.h"

#include <gtest/gtest.h>

#include "tests/pipeline/render/scenes.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

FrameState view_of(const GivenVelocity& at, const Projection& projection) {
  return frame_state(show_of(at, projection), 0);
}

const WantedSkies kAllSkies{{true, true, true}};

const std::vector<GivenVelocity> kObservers{
    {Region::kI, Tetrad::kRain, 30, {0, 0, 0}},
    {Region::kI, Tetrad::kRain, 6, {0.2, 0.6, 0.3}},
    {Region::kI, Tetrad::kRain, 2.5, {-0.5, 1, 0.5}},
    {Region::kI, Tetrad::kOutgoing, 5, {1, 2, 3}},
    {Region::kII, Tetrad::kRain, 1.2, {0, 0.5, 0}},
    {Region::kII, Tetrad::kRain, 0.3, {0.3, 0, -1}},
    {Region::kIII, Tetrad::kRainOfThree, 4, {0.5, 0, 0}},
};

// Rays that are traced tell the same: a whole pixel away from the borders all of a pixel sees a sky
// or none.
TEST(SkyBorders, AreWhereTracedRaysChangeTheirSky) {
  std::mt19937 random(6);
  for (const GivenVelocity& at : kObservers) {
    const FrameState view = view_of(at, Domemaster{512});
    const ViewTracer tracer(view, kAllSkies);
    const SkyBorders borders(tracer, view.projection);
    ASSERT_TRUE(borders.usable());
    int seen[2] = {0, 0}, partly = 0;
    for (int k = 0; k < 20'000; ++k) {
      const CameraDirection n{random_direction(random)};
      const ViewRay ray = tracer.trace(n);
      const double pixel = 0.02, part = borders.part_in_skies(n, pixel);
      const bool sky = ray.sky != SkyRegion::kIV;
      if (ray.to_edge > 0.6 * pixel) {
        ASSERT_EQ(part, sky ? 1 : 0) << "r " << at.r << ", " << ray.to_edge;
        ++seen[sky ? 1 : 0];
      } else {
        // The part is more than a half on the sky's side.
        ASSERT_GE(sky ? part : 1 - part, 0.49) << "r " << at.r;
        ++partly;
      }
    }
    EXPECT_GT(seen[0], 20);
    EXPECT_GT(seen[1], 20);
    EXPECT_GT(partly, 20);
  }
}

// A sky that begins as a point in the dark lets no star of another sky shine into the dark.
TEST(SkyBorders, EndStarsWhileAWindowOpens) {
  for (const double r : {1.9999, 1.999, 1.99, 1.97, 1.9}) {
    const Show show =
        starry(show_of(GivenVelocity{Region::kII, Tetrad::kRain, r, {0, 0, 0}}, Domemaster{256}));
    const FrameState state = frame_state(show, 0);
    const SkyBorders borders(ViewTracer(state, kAllSkies), state.projection);
    ASSERT_TRUE(borders.usable());
    FloatImage frame;
    Renderer(show, 1).render(state, frame);
    int dark = 0;
    for (int row = 0; row < frame.height; ++row)
      for (int column = 0; column < frame.width; ++column) {
        const PixelPosition pixel{column + 1.0, row + 1.0};
        const CameraDirection n = direction_at(state.projection, pixel);
        if (!is_inside(state.projection, pixel) ||
            borders.sight_around(n, pixel_angle(state.projection, pixel)) !=
                SkyBorders::Sight::kNoSky)
          continue;
        ++dark;
        ASSERT_EQ(frame.row(row)[3 * column], 0) << r << ", " << column << ", " << row;
      }
    EXPECT_GT(dark, 1000) << r;
  }
}

// What is said of a neighbourhood holds for each of its pixels.  Of random ones a border's circle
// meets a part of `reach`, since the component along its axis is spread evenly from -1 to 1.
TEST(SkyBorders, KnowWhatNeighbourhoodsSee) {
  constexpr int kPlaces = 2000;
  constexpr double kReach = 0.03, kPixel = 0.006;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(0, 1);
  int skies = 0, dark = 0;
  for (const GivenVelocity& at : kObservers) {
    const FrameState view = view_of(at, Domemaster{512});
    const SkyBorders borders(ViewTracer(view, kAllSkies), view.projection);
    int unsaid = 0;
    for (int k = 0; k < kPlaces; ++k) {
      const CameraDirection n{random_direction(random)};
      const SkyBorders::Sight sight = borders.sight_around(n, kReach);
      if (sight == SkyBorders::Sight::kBoth) {
        ++unsaid;
        continue;
      }
      const bool sky = sight == SkyBorders::Sight::kSky;
      ++(sky ? skies : dark);
      for (int m = 0; m < 40; ++m) {
        // Even the corners of the pixel are within reach.
        const double away = (kReach - kPixel * std::sqrt(0.5)) * std::sqrt(u(random));
        const V3d step = random_direction(random).cross(n.v).normalized() * away;
        ASSERT_EQ(borders.part_in_skies({(n.v + step).normalized()}, kPixel), sky ? 1 : 0)
            << "r " << at.r;
      }
    }
    EXPECT_LT(unsaid, 2.5 * kReach * kPlaces);
  }
  EXPECT_GT(skies, kPlaces);
  EXPECT_GT(dark, kPlaces);
}

// Returns how many pixels see no sky.  The box must hold them all.
int pixels_without_sky(const FrameState& view) {
  const Projection& projection = view.projection;
  const ViewTracer tracer(view, kAllSkies);
  const auto box = SkyBorders(tracer, projection).box_without_sky();
  int count = 0, outside = 0;
  for (int row = 0; row < rows(projection); ++row)
    for (int column = 0; column < columns(projection); ++column) {
      const PixelPosition pixel{column + 1.0, row + 1.0};
      if (!is_inside(projection, pixel) ||
          tracer.trace(direction_at(projection, pixel)).sky != SkyRegion::kIV)
        continue;
      ++count;
      outside += !box || column < box->first_column || column > box->last_column ||
                 row < box->first_row || row > box->last_row;
    }
  EXPECT_EQ(outside, 0) << "r " << view.observer.r;
  return count;
}

TEST(SkyBorders, BoxHoldsAllThatSeesNoSky) {
  for (const Projection& projection :
       {Projection(Domemaster{128}), Projection(Stereographic{160, 90, 1.5})})
    for (const GivenVelocity& at : kObservers) pixels_without_sky(view_of(at, projection));
}

// The hole stands where the projection has its antipode, or below the rim of a dome.
TEST(SkyBorders, BoxHoldsAHoleBehindTheCamera) {
  for (const auto& [projection, attitude, elevation] :
       {std::tuple(Projection(Stereographic{960, 540, 5.6}), Attitude(LookOutward{}), 0.0),
        std::tuple(Projection(Domemaster{128}), Attitude(LookAtHole{}), -30.0),
        std::tuple(Projection(Domemaster{128}), Attitude(LookOutward{}), 80.0)})
    for (const double r : {3.3, 8.0}) {
      Show show = show_of(StaticObserver{r}, projection);
      show.timeline[0].camera.attitude = attitude;
      show.timeline[0].camera.elevation = elevation * kDegree;
      pixels_without_sky(frame_state(show, 0));
    }
}

// About a spin the border is a polygon.
class SpinBorders : public ShowFile {};
TEST_F(SpinBorders, BoxHoldsAllThatSeesNoSky) {
  for (const std::string look : {"hole", "outward"})
    for (const std::string at : {"static, r: 9", "circular, r: 4", "static, r: 2.2"}) {
      const Show show = read("size: 64\ncamera: {look_at: " + look + ", elevation_deg: 20}\n" +
                             "black_hole: {mass_solar: 1e8, spin: 0.9}\n"
                             "sky: {region_I: {background: black, stars: none}}\n"
                             "timeline:\n  - {duration_s: 1, trajectory: {type: " +
                             at + "}}\n");
      const FrameState view = frame_state(show, 0);
      const int dark = pixels_without_sky(view);
      EXPECT_GT(dark, look == "hole" ? 25 : -1) << at;
      const auto box = SkyBorders(ViewTracer(view, kAllSkies), view.projection).box_without_sky();
      if (at == "static, r: 9" && look == "hole") {
        ASSERT_TRUE(box);
        // Hardly more than the silhouette is in it.
        EXPECT_LT((box->last_column - box->first_column) * (box->last_row - box->first_row),
                  4 * dark);
      }
    }
}

// Bright stars glow all around the silhouette, and not into it.
TEST(SkyBorders, EndTheBlobsOfStars) {
  Show show = show_of(StaticObserver{8}, Domemaster{256});
  show.sky[SkyRegion::kI].stars = StarField{kTestAssets + "stars_to_9.stars", 6.5};
  show.point_spread.halo = 0.5;
  show.point_spread.halo_sigma = 1 * kDegree;
  show.exposure.ev = 8;
  const FrameState state = frame_state(show, 0);
  const HalfFrame frame = Renderer(show, 2).render(state);
  const ViewTracer tracer(state, WantedSkies{});
  int lit = 0, dark = 0;
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column) {
      const PixelPosition pixel{column + 1.0, row + 1.0};
      if (!is_inside(state.projection, pixel)) continue;
      const ViewRay ray = tracer.trace(direction_at(state.projection, pixel));
      const float green = frame.row(row)[3 * column + 1];
      if (ray.to_edge < pixel_angle(state.projection, pixel)) continue;
      if (ray.sky == SkyRegion::kIV) {
        ASSERT_EQ(green, 0) << column << " " << row;
        ++dark;
      } else if (ray.to_edge < 0.1) {
        lit += green > 0 ? 1 : 0;
      }
    }
  EXPECT_GT(dark, 500);
  EXPECT_GT(lit, 500);
}

}  // namespace
}  // namespace domefall
