// A disc hides what is behind it: skies and stars alike, and by as much as it is opaque.
#include <gtest/gtest.h>

#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

DiscView usual_view(double opacity) {
  DiscView view{{Region::kI, Tetrad::kRain, 30, {0.1, 0.2, 0}}, normal_seen_from(12), Disc{}};
  view.disc.opacity = opacity;
  return view;
}

const Projection kDiscDome = Domemaster{tries(240, 100)};

struct Skies {
  bool panorama = false, stars = false;
};

FloatImage disc_frame(const DiscView& view, bool disc, const Skies& skies) {
  const Show whole = starry(disc_show(view, kDiscDome));
  Show show = disc_show(view, kDiscDome);
  if (!disc) show.disc.reset();
  if (skies.panorama) show.sky[SkyRegion::kI].background = whole.sky[SkyRegion::kI].background;
  if (skies.stars) show.sky[SkyRegion::kI].stars = whole.sky[SkyRegion::kI].stars;
  return render_floats(show);
}

// The part of a sky's light that is left at each value of a frame, where there is light.
TEST(DiscHides, StarsAsItHidesTheSky) {
  for (const double opacity : {1.0, 0.6}) {
    const DiscView view = usual_view(opacity);
    const FloatImage disc = disc_frame(view, true, {}),
                     sky = disc_frame(view, false, {true, false}),
                     stars = disc_frame(view, false, {false, true}),
                     disc_sky = disc_frame(view, true, {true, false}),
                     disc_stars = disc_frame(view, true, {false, true});
    int hidden = 0, cut = 0, free = 0;
    for (std::size_t k = 0; k < disc.pixels.size(); ++k) {
      if (!(sky.pixels[k] > 1e-3f) || disc.pixels[k] > 1e3f * sky.pixels[k]) continue;
      const float left = (disc_sky.pixels[k] - disc.pixels[k]) / sky.pixels[k];
      const float rounding = 1e-6f * (disc.pixels[k] + stars.pixels[k]) / sky.pixels[k];
      ASSERT_GT(left, -1e-3f - rounding);
      ASSERT_LT(left, 1 + 1e-3f + rounding);
      ASSERT_NEAR(disc_stars.pixels[k] - disc.pixels[k], left * stars.pixels[k],
                  2e-3f * stars.pixels[k] + 2e-6f * disc.pixels[k] + 1e-6f)
          << k;
      if (stars.pixels[k] < 1e-3f) continue;
      free += left > 0.999f;
      hidden += left < 1.001f * static_cast<float>(1 - opacity) + 1e-3f;
      cut += left < 0.95f && left > 0.05f + static_cast<float>(1 - opacity);
    }
    EXPECT_GT(free, 500);
    EXPECT_GT(hidden, 300);
    EXPECT_GT(cut, 20);
  }
}

TEST(DiscHides, NothingIfItIsQuiteTransparent) {
  const DiscView view = usual_view(0);
  const FloatImage with = disc_frame(view, true, {true, true}),
                   without = disc_frame(view, false, {true, true});
  EXPECT_EQ(with.pixels, without.pixels);
}

// The light of a pixel that a rim crosses goes evenly from the one to the other as the rim passes.
TEST(DiscHides, StarsAtItsRimWithoutBlinking) {
  constexpr int kSteps = 24;
  DiscView view = usual_view(1);
  view.at.celerity = celerity_of_rest(30);
  std::vector<double> lights;
  for (int step = 0; step < kSteps; ++step) {
    // The outer rim moves by a sixth of a pixel of this frame a step.
    view.disc.outer = 18 + step * 0.1;
    view.disc.luminance = 1e-12;  // black against the stars
    lights.push_back(
        illuminance(disc_show(view, kDiscDome), disc_frame(view, true, {false, true})));
  }
  double most = 0;
  for (std::size_t k = 1; k < lights.size(); ++k) {
    EXPECT_LE(lights[k], lights[k - 1] * (1 + 1e-6)) << k;
    most = std::max(most, lights[k - 1] - lights[k]);
  }
  const double hidden = lights.front() - lights.back();
  EXPECT_GT(hidden, 0.01 * lights.front());
  EXPECT_LT(most, hidden / 4);
}

}  // namespace
}  // namespace domefall
