// Skies that are smaller than a pixel keep their light.
#include "pipeline/render/sky/unresolved_sky.h"

#include <gtest/gtest.h>

#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// The pixel values of a frame that shows region III alone, `aside_pixels` beside its middle: summed
// over the channels, averaged over the pixels.
double light_of_region_three(double depth, double aside_pixels, int size) {
  Show show = show_of(RadialInfall{2 - depth}, Domemaster{size});
  show.sky[SkyRegion::kIII].background = PanoramaSky{small_panorama()};
  // Domemaster pixels are pi/size wide.
  show.timeline[0].camera.elevation = (90 * kDegree) - aside_pixels * std::numbers::pi / size;
  const HalfFrame frame = Renderer(show, 2).render(frame_state(show, 0));
  double sum = 0;
  for (const Imath::half value : frame.pixels) sum += value;
  return sum / (size * size);
}

TEST(UnresolvedSkies, RegionThreeBringsTheSameLightHoweverSmallItIs) {
  // Its panorama's intensity grows like the frequency squared, and its size falls as much.
  const double last = light_of_region_three(1e-9, 0, 128);
  EXPECT_GT(last, 0);
  for (const double depth : {1e-3, 1e-4, 1e-6})
    EXPECT_NEAR(light_of_region_three(depth, 0, 128) / last, 1, 0.01) << depth;
  // The same holds for an image of another size, whose pixels have a quarter of the area.
  EXPECT_NEAR(light_of_region_three(1e-6, 0, 256) / last, 1, 0.01);
}

TEST(UnresolvedSkies, DoNotTwinkleBetweenPixels) {
  const double middle = light_of_region_three(1e-6, 0, 128);
  for (const double aside : {0.25, 0.5, 0.75, 3.3})
    EXPECT_NEAR(light_of_region_three(1e-6, aside, 128) / middle, 1, 2e-3) << aside;
}

// The light of the own sky that arrives by way of the core, within a dark ring about the middle, at
// this distance inside the inner horizon in parts of its radius.
double light_from_the_core(double depth, double aside_pixels, int size) {
  Show show = show_of(StaticObserver{10}, Domemaster{size});
  show.sky[SkyRegion::kI].background = PanoramaSky{small_panorama()};
  show.timeline[0].camera.elevation = (90 * kDegree) - aside_pixels * std::numbers::pi / size;
  const double inner = ChargedHole(1, 0.8).inner_horizon();
  const HalfFrame frame =
      Renderer(show, 2).render(state_near_charge(show, {0.8, inner * (1 - depth), Region::kV}));
  double sum = 0;
  const int reach = size / 16;  // a quarter of the ring's radius
  for (int y = size / 2 - reach; y < size / 2 + reach; ++y)
    for (int x = size / 2 - reach; x < size / 2 + reach; ++x) sum += frame.row(y)[3 * x];
  return sum / (size * size);
}

TEST(UnresolvedSkies, TheCoreBringsTheSameLightHoweverSmallItIs) {
  const double last = light_from_the_core(1e-7, 0, 128);
  EXPECT_GT(last, 0);
  for (const double depth : {1e-4, 1e-5, 1e-6})
    EXPECT_NEAR(light_from_the_core(depth, 0, 128) / last, 1, 0.02) << depth;
  for (const double aside : {0.25, 0.5, 0.75, 1.3})
    EXPECT_NEAR(light_from_the_core(1e-5, aside, 128) / last, 1, 0.02) << aside;
  EXPECT_NEAR(light_from_the_core(1e-5, 0, 256) / last, 1, 0.02);
}

TEST(UnresolvedSkies, AreNotSoughtWhereNothingIsCrowded) {
  const Show show = starry(show_of(StaticObserver{10}, Domemaster{128}));
  const FrameState state = frame_state(show, 0);
  SkyStore store(show);
  const UnresolvedSkies found = find_unresolved_skies(scene_with(
      show, state,
      {&store.sky(SkyRegion::kI, show.sky[SkyRegion::kI].background, true), nullptr, nullptr}));
  EXPECT_TRUE(found.blobs.empty());
  EXPECT_TRUE(found.darkened.empty());
}

// The red light of a whole dome under a panorama of one value.  The observer moves at this Lorentz
// factor in flat space, or at r in a show without lensing.
double light_of_an_even_sky(double gamma, double aside_pixels, int size, double r = kFlatSpace) {
  Show show =
      show_of(GivenVelocity{Region::kI, Tetrad::kRain, r, {0, 0, std::sqrt(gamma * gamma - 1)}},
              Domemaster{size});
  // The zenith lies along the motion, or `aside_pixels` beside it.
  show.timeline[0].camera.attitude =
      EulerAngles{90 * kDegree, 90 * kDegree - aside_pixels * std::numbers::pi / size, 0};
  const PanoramaFile panorama(64, [](int) { return 0.5f; });
  show.sky[SkyRegion::kI].background = PanoramaSky{panorama.path()};
  show.effects.lensing = r == kFlatSpace;
  const HalfFrame frame = Renderer(show, 2).render(frame_state(show, 0));
  double sum = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double value = frame.row(y)[3 * x];
      if (value > 0) sum += value * pixel_solid_angle(show.projection, {x + 1.0, y + 1.0});
    }
  return sum;
}

// The light of the dome, the half space ahead, in units of that at rest.  A panorama's light
// changes by g^2 for g >= 1 and by exp(1 - 1/g) below ([Riazuelo] sec. ssec_rgb), and each
// steradian of the sky becomes 1/g^2 steradians.  The dome shows the sky out to tan(alpha/2) =
// gamma + |celerity|, where g = gamma (1 + beta cos(alpha)) = 1/gamma.  The integral is taken in
// the logarithm of g.
double aberrated(double gamma) {
  const double beta = std::sqrt(1 - 1 / (gamma * gamma));
  double sum = 0;
  constexpr int kSteps = 2'000'000;
  const double end = (1 + beta) * gamma, step = std::log(end * gamma) / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const double g = std::exp((k + 0.5) * step) / gamma;
    sum += 2 * std::numbers::pi * step / (beta * gamma) * (g < 1 ? std::exp(1 - 1 / g) / g : g);
  }
  return sum;
}

TEST(UnresolvedSkies, InFlatSpaceTheLightAheadFollowsTheAberration) {
  const double at_rest = light_of_an_even_sky(1, 0, 128) / (2 * std::numbers::pi);
  EXPECT_GT(at_rest, 0);
  const auto ratio = [at_rest](double gamma, double aside, int size, double r = kFlatSpace) {
    return light_of_an_even_sky(gamma, aside, size, r) / at_rest / aberrated(gamma);
  };
  for (const double gamma : {1e1, 1e3, 1e4, 1e5, 1e9})
    EXPECT_NEAR(ratio(gamma, 0, 128), 1, 0.01) << gamma;
  // A sky that is hardly smaller than a cap also lights the pixels around it.  These are sampled in
  // their middles, where there is less light than in their mean.
  EXPECT_NEAR(ratio(1e2, 0, 128), 1, 0.025);
  EXPECT_NEAR(ratio(1e3, 0, 1024), 1, 0.025);
  EXPECT_NEAR(ratio(1e4, 0, 1024), 1, 0.01);
  for (const double aside : {0.25, 0.5, 3.3}) EXPECT_NEAR(ratio(1e4, aside, 128), 1, 0.01) << aside;
}

// Light goes straight there too, and a hole so far away makes no other difference.
TEST(UnresolvedSkies, WithoutLensingAreThoseOfFlatSpace) {
  EXPECT_NEAR(light_of_an_even_sky(1e4, 0, 128, 1e8) / light_of_an_even_sky(1e4, 0, 128), 1, 0.01);
}

}  // namespace
}  // namespace domefall
