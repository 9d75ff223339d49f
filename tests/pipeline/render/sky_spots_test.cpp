// Skies that are smaller than a pixel keep their light.
#include "pipeline/render/sky_spots.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace domefall {
namespace {

// Region III alone, seen in the middle of the picture or a part of a pixel beside it.
double light_of_region_three(double depth, double aside_pixels, int size) {
  Show show = show_of(RadialInfall{2 - depth}, Domemaster{size});
  show.sky_three.background = PanoramaSky{small_panorama()};
  // Domemaster pixels are pi/size wide.
  show.timeline[0].camera.elevation = (90 * kDegree) - aside_pixels * std::numbers::pi / size;
  const HalfFrame frame = Renderer(show, 2).render(frame_state(show, 0));
  double sum = 0;
  for (const Imath::half value : frame.pixels) sum += value;
  return sum / (size * size);
}

TEST(SkySpots, RegionThreeBringsTheSameLightHoweverSmallItIs) {
  // Its panorama's intensity grows like the frequency squared, its size falls as much.
  const double last = light_of_region_three(1e-9, 0, 128);
  EXPECT_GT(last, 0);
  for (const double depth : {1e-3, 1e-4, 1e-6})
    EXPECT_NEAR(light_of_region_three(depth, 0, 128) / last, 1, 0.01) << depth;
  // And in a picture of another size: pixels of a quarter of the area.
  EXPECT_NEAR(light_of_region_three(1e-6, 0, 256) / last, 1, 0.01);
}

TEST(SkySpots, DoNotTwinkleBetweenPixels) {
  const double middle = light_of_region_three(1e-6, 0, 128);
  for (const double aside : {0.25, 0.5, 0.75, 3.3})
    EXPECT_NEAR(light_of_region_three(1e-6, aside, 128) / middle, 1, 2e-3) << aside;
}

TEST(SkySpots, AreNotSoughtWhereNothingIsCrowded) {
  const Show show = starry(show_of(StaticObserver{10}, Domemaster{128}));
  const FrameState state = frame_state(show, 0);
  Scene scene(show);
  const HoleOptics optics = make_hole_optics(10, Tetrad::kRain, {});
  const SkySpots spots =
      find_sky_spots(show, state, optics, {&scene.sky(SeenSky::kOne), nullptr, nullptr});
  EXPECT_TRUE(spots.blobs.empty());
  EXPECT_TRUE(spots.darkened.empty());
}

}  // namespace
}  // namespace domefall
