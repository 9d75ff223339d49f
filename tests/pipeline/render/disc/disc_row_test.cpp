#include <gtest/gtest.h>

#include <vector>

#include "pipeline/render/disc/disc_pass.h"
#include "pipeline/render/disc/rim_coverage.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

// The values of a frame that are drawn with each pixel by itself, and those by rows.
struct Drawn {
  FloatImage singly, by_rows;
};

Drawn drawn_row(const DiscView& view, const Projection& projection) {
  const Show show = disc_show(view, projection);
  const FrameState state = frame_state(show, 0);
  const DiscLight light(*show.disc);
  const FrameScene scene(show, state, plan_frame(show, state),
                         lens_of(state.observer, WantedSkies{}, show.effects), {}, {}, &light);
  const DiscPass pass(scene);
  const int width = columns(projection), height = rows(projection);
  Drawn frames{FloatImage(width, height), FloatImage(width, height)};
  // What is behind the disc is not black.
  std::fill(frames.singly.pixels.begin(), frames.singly.pixels.end(), 0.25f);
  frames.by_rows.pixels = frames.singly.pixels;
  pass.draw_rows_singly(0, height, frames.singly.row(0));
  pass.draw_rows(0, height, frames.by_rows.row(0));
  return frames;
}

Disc disc_of(double opacity, bool plunging = false) {
  Disc disc{.opacity = opacity, .plunging = plunging};
  if (plunging) disc.inner = 2.5;
  return disc;
}

Disc translucent() {
  Disc disc = disc_of(1);
  disc.optical_depth = 1, disc.rim = 0.3;
  return disc;
}

Disc turbulent() {
  Disc disc = translucent();
  disc.patterns = {TurbulencePattern{}, SpotPattern{}};
  return disc;
}

// Far away and near, above the plane and in it, between the images, inside the horizon, and fast.
std::vector<DiscView> views() {
  constexpr Region kI = Region::kI;
  constexpr Tetrad kRain = Tetrad::kRain;
  return {{{kI, kRain, 15, celerity_of_rest(15)}, normal_seen_from(10), disc_of(1)},
          {{kI, kRain, 40, celerity_of_rest(40)}, normal_seen_from(80), disc_of(0.6)},
          {{kI, kRain, 18, celerity_of_rest(18)}, normal_seen_from(50), translucent()},
          {{kI, kRain, 14, celerity_of_rest(14)}, normal_seen_from(-40), turbulent()},
          {{kI, kRain, 30, celerity_of_rest(30)}, normal_seen_from(0.3), disc_of(0.8)},
          {{kI, kRain, 12, {0.4, -0.2, 0.5}}, normal_seen_from(1), disc_of(1)},
          {{kI, kRain, 9, celerity_of_rest(9)}, normal_seen_from(0), disc_of(1)},
          {{kI, kRain, 4, {0, 0, 0}}, V3d(0.3, -1, 0.2), disc_of(0.5)},
          {{Region::kII, kRain, 1, {0, 0.3, 0}}, V3d(0.1, -1, 0.4), disc_of(0.7, true)},
          {{kI, Tetrad::kOutgoing, 10, {-0.5, 0.3, 0.1}}, V3d(0.7, 0.7, 0.1), disc_of(1)},
          {{kI, kRain, 25, {1.5, 1.2, -2}}, V3d(0.3, -0.8, 0.4), disc_of(0.9)}};
}

TEST(DiscRow, IsThatOfItsPixels) {
  int differ = 0;
  for (std::size_t v = 0; v < views().size(); ++v) {
    const Drawn frames = drawn_row(views()[v], Domemaster{tries(512, 256)});
    const std::vector<float>&singly = frames.singly.pixels, &by_rows = frames.by_rows.pixels;
    // The place at which a pixel sees a pattern is right to a small part of the pixel.
    const float off = views()[v].disc.patterns.empty() ? 0 : 3e-3f;
    for (std::size_t k = 0; k < singly.size(); ++k) {
      differ += singly[k] != by_rows[k];
      ASSERT_NEAR(by_rows[k], singly[k], 1e-3f * singly[k] + off * (1 + singly[k]))
          << "view " << v << ", value " << k;
    }
  }
  EXPECT_GT(differ, 1000);
}

// The light of a line that crosses rows of pixels, or diagonals, `apart` pixels from one another.
double light_of_line(double at, double apart) {
  constexpr double kWidth = 1e-3;
  double sum = 0;
  for (int k = -4; k <= 4; ++k)
    sum += beyond_rim(at + kWidth - k * apart) - beyond_rim(at - k * apart);
  return sum * apart / kWidth;
}

TEST(RimCoverage, OfALineIsTheSameWhereverItLies) {
  for (double at = -0.5; at <= 0.5; at += 0.01) {
    EXPECT_NEAR(light_of_line(at, 1), 1, 1e-9) << at;
    EXPECT_NEAR(light_of_line(at, std::sqrt(0.5)), 1, 1e-9) << at;
    // Rows two columns long, between which it steps: the next pattern of parallel lines of pixels.
    EXPECT_NEAR(light_of_line(at, std::sqrt(0.2)), 1, 0.04) << at;
  }
}

TEST(RimCoverage, HasAnInverse) {
  for (double off = -kRimReach; off <= kRimReach; off += 0.01)
    EXPECT_NEAR(distance_to_rim(beyond_rim(off)), off, 1e-7);
  EXPECT_EQ(distance_to_rim(0.5), 0);
  EXPECT_EQ(beyond_rim(1), 1);
  EXPECT_EQ(beyond_rim(-1), 0);
}

}  // namespace
}  // namespace domefall
