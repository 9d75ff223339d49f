#include "pipeline/render/rays/shift_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"

namespace domefall {
namespace {

// The range is held against the code that renders frames: no view ray is beyond it, and some come
// close to its ends.
struct Observed {
  const char* name;
  Spacetime spacetime;
  Region region;
  Tetrad tetrad;
  int universe;
  double r;
  Celerity<ReferenceTetrad> celerity;
};

std::vector<Observed> observers() {
  const Spacetime hole = Schwarzschild{}, charge = ChargedHole(1, 0.8L),
                  naked = ChargedHole(1, 1.1L);
  const Tetrad rain = Tetrad::kRain, out = Tetrad::kOutgoing, three = Tetrad::kRainOfThree;
  return {{"rest", hole, Region::kI, rain, 0, 5, resting_celerity(5)},
          {"rain", hole, Region::kI, rain, 0, 3, {0, 0, 0}},
          {"sideways", hole, Region::kI, rain, 0, 3, {0.2, -0.3, 0.9}},
          {"outgoing", hole, Region::kI, out, 0, 4, {0.1, 0.2, 0.5}},
          {"inside", hole, Region::kII, rain, 0, 1.2, {0.3, 0.1, 0.6}},
          {"of three", hole, Region::kIII, three, 0, 6, {-0.3, 0.5, 0}},
          {"fast", hole, Region::kI, rain, 0, 2.5, {-3, 0, 4}},
          {"charge", charge, Region::kI, out, 0, 3, {0.2, -0.3, 0.9}},
          {"between", charge, Region::kII, rain, 1, 1, {0.3, 0.1, 0.6}},
          {"within", charge, Region::kV, rain, 0, 0.39, {0.3, 0.1, 0.6}},
          {"at the core", charge, Region::kV, out, 0, 0.3, {0, 0.7, 0}},
          {"rising", charge, Region::kIV, out, 1, 0.9, {0.3, 0.1, 0.6}},
          {"beyond", charge, Region::kI, out, 1, 2.1, {0.3, 0.1, 0.6}},
          {"naked", naked, Region::kI, rain, 0, 1.5, {-0.3, 0.1, 0.6}}};
}

TEST(FrequencyRange, IsThatOfManyViewRays) {
  for (const Observed& c : observers()) {
    FrameState state;
    state.observer.spacetime = c.spacetime, state.observer.universe = c.universe;
    state.observer.region = c.region, state.observer.tetrad = c.tetrad;
    state.observer.r = c.r, state.observer.celerity = c.celerity;
    const ViewTracer tracer(state, WantedSkies{});
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    PerSky<ShiftRange> seen;
    for (ShiftRange& range : seen.values) range = {HUGE_VAL, 0};
    for (int k = 0; k < 300'000; ++k) {
      const V3d n(normal(generator), normal(generator), normal(generator));
      const ViewRay ray = tracer.trace(CameraDirection{n.normalized()});
      if (!ray.known) continue;
      auto& [least, largest] = seen[ray.sky];
      least = std::min(least, ray.frequency_ratio);
      largest = std::max(largest, ray.frequency_ratio);
    }
    for (const SkyRegion sky : kExteriorSkies) {
      const auto range = frequency_range(state.observer, sky, false);
      const auto [least, largest] = seen[sky];
      ASSERT_EQ(range.has_value(), largest > 0) << c.name;
      if (!range) continue;
      EXPECT_GE(least, range->least * (1 - 1e-9)) << c.name;
      EXPECT_LE(largest, range->largest * (1 + 1e-9)) << c.name;
      // 3e5 rays are a degree apart.
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
