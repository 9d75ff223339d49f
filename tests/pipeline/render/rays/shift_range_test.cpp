#include "pipeline/render/rays/shift_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

// The range is held against the code that renders frames: no view ray is beyond it, and some come
// close to its ends.
struct Observed {
  const char* name;
  Region region;
  Tetrad tetrad;
  double r;
  Celerity<ReferenceTetrad> celerity;
};
TEST(FrequencyRange, IsThatOfManyViewRays) {
  for (const Observed& c :
       {Observed{"rest", Region::kI, Tetrad::kRain, 5, resting_celerity(5)},
        Observed{"rain", Region::kI, Tetrad::kRain, 3, {0, 0, 0}},
        Observed{"sideways", Region::kI, Tetrad::kRain, 3, {0.2, -0.3, 0.9}},
        Observed{"outgoing", Region::kI, Tetrad::kOutgoing, 4, {0.1, 0.2, 0.5}},
        Observed{"inside", Region::kII, Tetrad::kRain, 1.2, {0.3, 0.1, 0.6}},
        Observed{"of three", Region::kIII, Tetrad::kRainOfThree, 6, {-0.3, 0.5, 0}},
        Observed{"fast", Region::kI, Tetrad::kRain, 2.5, {-3, 0, 4}}}) {
    FrameState state;
    state.observer.spacetime = Schwarzschild{};
    state.observer.region = c.region, state.observer.tetrad = c.tetrad;
    state.observer.r = c.r, state.observer.celerity = c.celerity;
    const ViewTracer tracer(state, WantedSkies{});
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    for (const SkyRegion sky : kExteriorSkies) {
      const auto range = frequency_range(state.observer, sky, false);
      ASSERT_EQ(range.has_value(), sky == own_sky(c.tetrad, 0) || c.r < 2) << c.name;
      if (!range) continue;
      double least = HUGE_VAL, largest = 0;
      for (int k = 0; k < 200'000; ++k) {
        const V3d n(normal(generator), normal(generator), normal(generator));
        const ViewRay ray = tracer.trace(CameraDirection{n.normalized()});
        if (!ray.known || ray.sky != sky) continue;
        least = std::min(least, ray.frequency_ratio);
        largest = std::max(largest, ray.frequency_ratio);
      }
      EXPECT_GE(least, range->least * (1 - 1e-9)) << c.name;
      EXPECT_LE(largest, range->largest * (1 + 1e-9)) << c.name;
      // 2e5 rays are a degree apart.
      EXPECT_LT(least, range->least * 1.05) << c.name;
      EXPECT_GT(largest, range->largest * 0.95) << c.name;
    }
  }
}

// The least ratio was 0 there, and 1 + z infinite.
TEST(FrequencyRange, BehindTheFastestObserverLightIsRedButThere) {
  ObserverState o;
  o.spacetime = Schwarzschild{};
  o.r = 8, o.celerity = {-1e9, 0, 0};
  const auto range = frequency_range(o, SkyRegion::kI, false);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least * 2e9 * 1.5, 1, 1e-12);  // gamma - gamma v over 1 + s
}

TEST(FrequencyRange, StraightLightHasNoSilhouette) {
  ObserverState o;
  o.spacetime = Schwarzschild{};
  o.r = 4, o.celerity = resting_celerity(4);
  const auto range = frequency_range(o, SkyRegion::kI, true);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->least, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(range->largest, std::sqrt(2.0), 1e-14);
}

}  // namespace
}  // namespace domefall
