// What is told of a pixel, against the pixel.
#include "pipeline/render/pixel_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/sources/disc/disc_light.h"
#include "pipeline/sources/stars/solar_system.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

Show disc_show(int width = 160) {
  Show show = starry(show_of(CircularOrbit{14}, Stereographic{width, width * 3 / 4, 80 * kDegree}));
  show.spacetime = Schwarzschild{4e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  Disc disc{.normal = {V3d(0.2, 0.3, 0.9).normalized()}, .node = {V3d(0.9, 0, -0.2).normalized()}};
  show.disc = disc;
  return show;
}

// Gas at the radius, with the shift and the temperature that are told, has the light of the pixel.
TEST(PixelProbe, TellsTheGasWhoseLightThePixelHas) {
  const Show show = disc_show(640);
  const FrameState state = frame_state(show, 0);
  FloatImage frame;
  Renderer(show, 2).render(state, frame);
  const DiscLight light(*show.disc);
  const double exposure = exposure_scale(state.settings);
  int direct = 0, later = 0;
  for (int row = 12; row < frame.height; row += 28)
    for (int column = 8; column < frame.width; column += 20) {
      const PixelProbe probe(show, state, {column + 1.0, row + 1.0});
      const auto places = probe.disc();
      if (places.empty() || places[0].covered < 1) continue;
      const DiscAtPixel& first = places[0];
      // Next to the inner rim the light changes much within a pixel.
      if (first.r < 8) continue;
      const WorkingRgb expected = light.light(first.r, first.frequency_ratio);
      ASSERT_NEAR(frame.row(row)[3 * column + 1], exposure * expected.g,
                  0.02 * exposure * expected.g)
          << column << " " << row << " r = " << first.r;
      EXPECT_EQ(first.temperature, light.temperature(first.r));
      EXPECT_EQ(probe.left_of_sky(), 0);
      (first.order == 0 ? direct : later) += 1;
    }
  EXPECT_GT(direct, 30);
  EXPECT_GT(later, 0);
}

// A disc of the opacity 0.9 takes 2.5 magnitudes with each of its images, and an opaque one hides
// the star.
TEST(PixelProbe, TellsStarsBehindADiscAsFaintAsTheyAre) {
  const auto show_of_opacity = [](double opacity) {
    Show show = disc_show();
    show.disc->opacity = opacity;
    return show;
  };
  // A disc that hides next to nothing still tells where it is.
  const Show bare = show_of_opacity(1e-9), veiled = show_of_opacity(0.9),
             opaque = show_of_opacity(1);
  const FrameState state = frame_state(bare, 0);
  const auto find = [&](const Show& show, const StarAtPixel& star) -> std::optional<double> {
    for (const StarAtPixel& other : PixelProbe(show, frame_state(show, 0), star.at).stars())
      if (other.ra_deg == star.ra_deg && other.order == star.order) return other.seen_v;
    return std::nullopt;
  };
  int behind = 0, beside = 0;
  for (int row = 4; row < 120; row += 24)
    for (int column = 4; column < 160; column += 24) {
      const auto stars = PixelProbe(bare, state, {column + 1.0, row + 1.0}).stars();
      if (stars.empty()) continue;
      const StarAtPixel& star = stars[0];
      const auto places = PixelProbe(bare, state, star.at).disc();
      if (!std::ranges::all_of(places, [](const auto& place) { return place.covered == 1; }))
        continue;
      const auto count = static_cast<double>(places.size());
      EXPECT_NEAR(find(veiled, star).value_or(0), star.seen_v + 2.5 * count, 1e-6);
      EXPECT_EQ(find(opaque, star).has_value(), places.empty());
      (places.empty() ? beside : behind) += 1;
    }
  EXPECT_GT(behind, 3);
  EXPECT_GT(beside, 3);
}

// A planet is seen where the camera looks for it, by its name, and lights its pixel.
TEST(PixelProbe, TellsThePlanets) {
  Show show = starry(show_of(StaticObserver{}, Stereographic{64, 64, 20 * kDegree}));
  show.timeline[0].camera.attitude = LookAtSky{seen_from_earth(SolarBody::kJupiter, 2026.9)};
  FloatImage without, with;
  Renderer(show, 1).render(frame_state(show, 0), without);
  show.sky[SkyRegion::kI].stars->planets_year = 2026.9;
  const FrameState state = frame_state(show, 0);
  Renderer(show, 1).render(state, with);
  EXPECT_GT(with.row(32)[3 * 32], 10 * without.row(32)[3 * 32]);
  const auto stars = PixelProbe(show, state, {32.5, 32.5}).stars();
  ASSERT_FALSE(stars.empty());
  EXPECT_EQ(stars[0].names, std::vector<std::string>{"Jupiter"});
  EXPECT_NEAR(stars[0].v, planet_magnitude(SolarBody::kJupiter, 2026.9), 1e-6);
}

TEST(PixelProbe, TellsTheTitlesThatCoverThePixel) {
  Show show = show_of(StaticObserver{20}, Domemaster{200});
  Title title;
  title.text = "II";
  title.end_s = 1;
  title.elevation = 45 * kDegree;
  title.height = 30 * kDegree;
  show.titles = {title};
  const FrameState state = frame_state(show, 0);
  FloatImage frame;
  Renderer(show, 1).render(state, frame);
  int covered = 0;
  for (int row = 0; row < 200; row += 4)
    for (int column = 0; column < 200; column += 4) {
      const bool lit = frame.row(row)[3 * column] > 0;
      const auto titles = PixelProbe(show, state, {column + 1.0, row + 1.0}).titles();
      ASSERT_EQ(titles.size(), lit ? 1U : 0U) << column << " " << row;
      covered += lit;
    }
  EXPECT_GT(covered, 20);
}

}  // namespace
}  // namespace domefall
