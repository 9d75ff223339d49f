#include "pipeline/light/light_path.h"

#include <gtest/gtest.h>

#include <random>

#include "pipeline/light/charged_paths.h"
#include "pipeline/light/ray_orbits.h"
#include "pipeline/light/ray_times.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

double random_part(std::mt19937& random) { return static_cast<double>(random() % 100000) / 1e5; }

// By the closed form of orbits, in both frames, outside and inside.
TEST(LightPath, GoesWhereTheOrbitDoes) {
  std::mt19937 random(1);
  int compared = 0;
  for (const double r : {0.5, 1.9, 2.1, 3.0, 6.0, 20.0, 100.0})
    for (const Tetrad tetrad : {Tetrad::kRain, Tetrad::kOutgoing}) {
      if (tetrad == Tetrad::kOutgoing && r < 2) continue;
      for (int k = 0; k < 30; ++k) {
        const double alpha = 0.02 + random_part(random) * 3.1;
        const PlaneView view{Schwarzschild{}, r, tetrad};
        const LightPath path = light_path(view, alpha, 200);
        const double sine = std::sin(alpha / 2), cosine = std::cos(alpha / 2);
        RayOrbits orbits;
        orbits.set(r, is_outgoing(tetrad), {&sine, &cosine, nullptr, nullptr}, 1);
        const RayTimes times(orbits);
        for (std::size_t n = 5; n < path.places.size(); n += 7) {
          const LightPath::Place& place = path.places[n];
          if (place.psi > 6.3 || place.w > 0.499 || place.w < 1.0 / 150) continue;
          RayPlaces places;
          orbits.find(&place.psi, places);
          const double w = 1 / places.r[0];
          EXPECT_NEAR(place.w, w, 1e-5 * std::exp(place.psi)) << r << " " << alpha;
          EXPECT_NEAR(place.slope, -places.slope[0] * w * w, 1e-4 * std::exp(place.psi));
          double time = 0;
          times.find(&place.psi, places, &time);
          EXPECT_NEAR(place.time, time, 0.05) << r << " " << alpha;
          ++compared;
        }
      }
    }
  EXPECT_GT(compared, 500);
}

TEST(LightPath, NearAChargeGoesWhereItsPathsDo) {
  std::mt19937 random(2);
  const ChargedHole hole(1, 0.9);
  int compared = 0;
  for (const double r : {1.55, 3.0, 12.0})
    for (int k = 0; k < 30; ++k) {
      const double alpha = 0.02 + random_part(random) * 3.1;
      const LightPath path = light_path({hole, r, Tetrad::kRain}, alpha, 200);
      const ChargedPaths paths(hole, r);
      for (std::size_t n = 5; n < path.places.size(); n += 7) {
        const LightPath::Place& place = path.places[n];
        if (place.psi > 6.3 || place.w > 0.99 / hole.horizon() || place.w < 1.0 / 150) continue;
        const double p = path.places[0].slope, e = path.energy / path.momentum;
        ChargedPaths::Places places;
        paths.timed(&p, &e, &place.psi, 1, places);
        EXPECT_NEAR(place.w, places.w[0], 1e-5 * std::exp(place.psi)) << r << " " << alpha;
        EXPECT_NEAR(place.time, places.time[0], 0.05) << r << " " << alpha;
        ++compared;
      }
    }
  EXPECT_GT(compared, 200);
}

TEST(LightPath, GoesStraightWithoutLensing) {
  const LightPath path = light_path({Schwarzschild{}, 10.0, Tetrad::kRain, true}, 0.6, 50);
  ASSERT_GT(path.places.size(), 10U);
  for (const LightPath::Place& place : path.places) {
    const double t = std::sin(place.psi) / std::sin(0.6 + place.psi);  // sines of the triangle
    const double r = std::hypot(10 - 10 * t * std::cos(0.6), 10 * t * std::sin(0.6));
    EXPECT_NEAR(place.w, 1 / r, 1e-7);
  }
  EXPECT_NEAR(1 / path.places.back().w, 50, 5);
}

TEST(LightPath, EndsWhereNothingComesFromRegionI) {
  EXPECT_TRUE(light_path({Schwarzschild{}, 30.0, Tetrad::kRain}, 3, 20).places.empty());
  EXPECT_TRUE(light_path({Schwarzschild{}, 1.0, Tetrad::kRain}, 0.1, 20).places.empty());
  const LightPath down = light_path({Schwarzschild{}, 8.0, Tetrad::kRain}, 0.1, 20);
  EXPECT_NEAR(down.places.back().w, 0.5, 0.05);
}

}  // namespace
}  // namespace domefall
