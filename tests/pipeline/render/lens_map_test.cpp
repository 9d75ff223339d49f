#include "pipeline/render/lens_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/light/traced_ray.h"
#include "pipeline/sources/sky/orientation.h"
#include "tests/pipeline/render/scenes.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

Show falling_show(double r) { return show_of(RadialInfall{r}, Domemaster{64}); }

TEST(LensMap, PlacesOfMapsAreThoseOfPanoramas) {
  EXPECT_NEAR(sky_map_place(sky_direction(0, 0).v).s, 0.5, 1e-15);
  EXPECT_NEAR(sky_map_place(sky_direction(90, 0).v).s, 0.25, 1e-15);  // RA grows to the left
  EXPECT_NEAR(sky_map_place(sky_direction(0, 90).v).t, 1, 1e-15);
  const M33d turn = panorama_from_equatorial({});
  std::mt19937 random(1);
  for (int k = 0; k < 100; ++k) {
    const V3d d = random_direction(random), p = apply(turn, d);
    const SkyMapPlace at = sky_map_place(d);
    const double longitude = (0.5 - at.s) * 2 * std::numbers::pi,
                 latitude = (at.t - 0.5) * std::numbers::pi;
    EXPECT_NEAR(p.x, std::cos(latitude) * std::cos(longitude), 1e-14);
    EXPECT_NEAR(p.y, std::cos(latitude) * std::sin(longitude), 1e-14);
    EXPECT_NEAR(p.z, std::sin(latitude), 1e-14);
  }
  // Both sides of the seam, and the seam itself, are on the map.
  for (const double y : {0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17}) {
    const double s = sky_map_place({-1, y, 0}).s;
    EXPECT_TRUE(s >= 0 && s < 1) << y;
  }
}

// Rays of the exact integral, which shares the optics' formulas and neither their tables nor their
// batches, at random pixels.
TEST(LensMap, HoldsTheExactRays) {
  for (const double r : {12.0, 3.2, 2.4}) {
    const Show show = falling_show(r);
    const FrameState state = frame_state(show, 0);
    const ChannelImage map = make_lens_map(show, state, 2);
    std::mt19937 random(2);
    std::uniform_int_distribution<int> pixel(12, 51);
    for (int k = 0; k < 40; ++k) {
      const int x = pixel(random), y = pixel(random);
      const float* values = map.pixel(x, y);
      const V3d in = apply(state.observer.tetrad_from_camera,
                           direction_at(show.projection, {x + 1.0, y + 1.0}).v);
      RayRequest request;
      request.at = state.observer.r;
      request.delta = std::acos(-in.x);
      const TracedRay ray = trace_ray(request, TraceMethod::kExact);
      ASSERT_EQ(values[kSkyRegion], ray.origin == SkyRegion::kI ? 1 : 4) << x << ' ' << y;
      if (ray.origin == SkyRegion::kIV) continue;
      EXPECT_NEAR(values[kOnePlusZ], ray.one_plus_z, 1e-7 * ray.one_plus_z);
      EXPECT_EQ(values[kOrder], std::floor(ray.phi / std::numbers::pi));
      const double across = std::sin(ray.phi) / std::hypot(in.y, in.z);
      const V3d sky = apply(state.observer.sky_from_tetrad,
                            V3d(std::cos(ray.phi), in.y * across, in.z * across));
      EXPECT_NEAR(values[kSkyX], sky.x, 2e-7);
      EXPECT_NEAR(values[kSkyY], sky.y, 2e-7);
      EXPECT_NEAR(values[kSkyZ], sky.z, 2e-7);
    }
  }
}

TEST(LensMap, EndsWithTheImage) {
  const ChannelImage map = make_lens_map(falling_show(9), frame_state(falling_show(9), 0), 1);
  for (int c = 0; c < kLensChannels; ++c) EXPECT_EQ(map.pixel(0, 0)[c], 0) << c;
  EXPECT_EQ(map.channels.size(), std::size_t{kLensChannels});
}

TEST(LensMap, KeyTellsWhatTheMapDependsOn) {
  const Show show = falling_show(9);
  const FrameState state = frame_state(show, 3);
  const std::string key = lens_map_key(show, state);
  EXPECT_EQ(lens_map_key(show, frame_state(show, 3)), key);
  EXPECT_NE(lens_map_key(show, frame_state(show, 4)), key);
  FrameState other = state;
  other.projection = Domemaster{65};
  EXPECT_NE(lens_map_key(show, other), key);
  Show straight = show;
  straight.effects.lensing = false;
  EXPECT_NE(lens_map_key(straight, state), key);
  // What is in the sky is nothing to the lens.
  Show starred = show;
  starred.sky[SkyRegion::kI].stars = StarField{"nowhere.stars", 6};
  EXPECT_EQ(lens_map_key(starred, state), key);
}

}  // namespace
}  // namespace domefall
