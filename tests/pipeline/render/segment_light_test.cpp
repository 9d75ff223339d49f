// Tests of fades, and of backgrounds that differ from segment to segment or have a white.
#include <gtest/gtest.h>

#include "pipeline/render/frame_key.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// Two segments at rest, of a second each.
Show two_segments(int size = 64) {
  Show show = show_of(StaticObserver{10}, Domemaster{size});
  show.timeline.push_back(show.timeline.front());
  return show;
}

const int kSecond = 30;  // the first frame of the second segment

TEST(Fades, LeaveTheSamePartOfAllLight) {
  Show show = starry(two_segments());
  const HalfFrame whole = Renderer(show).render(frame_state(show, 15));
  show.timeline[0].fades.in_s = 1;
  const FrameState state = frame_state(show, 15);
  ASSERT_NEAR(state.fade, 0.25, 1e-12);
  const HalfFrame faded = Renderer(show).render(state);
  ASSERT_EQ(whole.pixels.size(), faded.pixels.size());
  double light = 0;
  for (std::size_t k = 0; k < whole.pixels.size(); ++k) {
    ASSERT_EQ(static_cast<float>(faded.pixels[k]),
              static_cast<float>(Imath::half(0.25f * static_cast<float>(whole.pixels[k]))));
    light += faded.pixels[k];
  }
  EXPECT_GT(light, 0);
  const HalfFrame black = Renderer(show).render(frame_state(show, 0));
  for (const Imath::half value : black.pixels) ASSERT_EQ(value, 0.0f);
}

TEST(Fades, OfADissolveLeaveEachViewItsOwnLight) {
  Show show = starry(two_segments());
  show.timeline[1].dissolve_s = 1;
  const HalfFrame both = Renderer(show).render(frame_state(show, 15));
  show.timeline[0].fades.out_s = show.timeline[1].fades.in_s = 1;
  const FrameState state = frame_state(show, 15);
  ASSERT_TRUE(state.vanishing);
  EXPECT_NEAR(state.fade, 0.25, 1e-12);
  EXPECT_NEAR(state.vanishing->fade, 0.25, 1e-12);
  const HalfFrame faded = Renderer(show).render(state);
  for (std::size_t k = 0; k < both.pixels.size(); ++k)
    ASSERT_NEAR(faded.pixels[k], 0.25f * both.pixels[k], 2e-3 * both.pixels[k] + 1e-6);
}

TEST(Fades, EnterTheKeysOfTheirFramesAlone) {
  Show show = starry(two_segments());
  const FrameKeys plain(show);
  const std::string early = plain.scene(frame_state(show, 3)),
                    late = plain.scene(frame_state(show, kSecond + 3));
  show.timeline[0].fades.in_s = 0.5;
  const FrameKeys faded(show);
  EXPECT_NE(faded.scene(frame_state(show, 3)), early);
  EXPECT_EQ(faded.scene(frame_state(show, kSecond + 3)), late);
}

TEST(SegmentBackgrounds, AreWhatTheirSegmentsShow) {
  Show show = two_segments();
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama()};
  Show grid = show;
  grid.sky[SkyRegion::kI].background = GridSky{};
  show.timeline[1].backgrounds[SkyRegion::kI] = GridSky{};
  Renderer renderer(show);
  EXPECT_EQ(renderer.render(frame_state(show, kSecond)).pixels,
            Renderer(grid).render(frame_state(grid, kSecond)).pixels);
  EXPECT_EQ(renderer.render(frame_state(show, 0)).pixels,
            Renderer(show).render(frame_state(show, 0)).pixels)
      << "the first background is still there";
  // A background that only one segment lights.
  Show lit = two_segments();
  lit.timeline[1].backgrounds[SkyRegion::kI] = GridSky{};
  const auto light = [&](int frame) {
    double sum = 0;
    for (const Imath::half value : Renderer(lit).render(frame_state(lit, frame)).pixels)
      sum += value;
    return sum;
  };
  EXPECT_EQ(light(0), 0);
  EXPECT_GT(light(kSecond), 0);
}

TEST(SegmentBackgrounds, DissolveIntoEachOther) {
  Show show = two_segments();
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama()};
  show.timeline[1].backgrounds[SkyRegion::kI] = GridSky{};
  Renderer renderer(show);
  const HalfFrame first = renderer.render(frame_state(show, 15)),
                  second = renderer.render(frame_state(show, kSecond));
  show.timeline[1].dissolve_s = 1;
  const HalfFrame mixed = renderer.render(frame_state(show, 15));
  for (std::size_t k = 0; k < mixed.pixels.size(); ++k)
    ASSERT_NEAR(mixed.pixels[k], 0.5f * first.pixels[k] + 0.5f * second.pixels[k],
                2e-3 * (first.pixels[k] + second.pixels[k]) + 1e-6);
}

TEST(SegmentBackgrounds, EnterTheKeysOfTheirFramesAlone) {
  Show show = starry(two_segments());
  const FrameKeys plain(show);
  const std::string first = plain.scene(frame_state(show, 0)),
                    second = plain.scene(frame_state(show, kSecond));
  show.timeline[1].backgrounds[SkyRegion::kI] = GridSky{};
  const FrameKeys own(show);
  EXPECT_EQ(own.scene(frame_state(show, 0)), first);
  const std::string grid = own.scene(frame_state(show, kSecond));
  EXPECT_NE(grid, second);
  show.timeline[1].backgrounds[SkyRegion::kI] = PanoramaSky{small_panorama(), 2};
  const std::string bright = FrameKeys(show).scene(frame_state(show, kSecond));
  EXPECT_NE(bright, grid);
  show.timeline[1].backgrounds[SkyRegion::kI] = PanoramaSky{small_panorama()};
  EXPECT_NE(FrameKeys(show).scene(frame_state(show, kSecond)), bright);
}

TEST(PanoramaWhites, MultiplyTheLightOfTheirPanoramas) {
  Show show = two_segments();
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama()};
  const HalfFrame plain = Renderer(show).render(frame_state(show, 0));
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama(), 4};
  const HalfFrame bright = Renderer(show).render(frame_state(show, 0));
  double light = 0;
  for (std::size_t k = 0; k < plain.pixels.size(); ++k) {
    ASSERT_NEAR(bright.pixels[k], 4 * plain.pixels[k], 2e-3 * bright.pixels[k] + 1e-6);
    light += plain.pixels[k];
  }
  EXPECT_GT(light, 0);
}

}  // namespace
}  // namespace domefall
