#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/sources/sky/formula_sky.h"
#include "tests/pipeline/sources/sky/grid_is_even.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

WorkingRgb seen(const SkyDirection& direction, double footprint) {
  return grid_colour(grid_light(direction, footprint), 1);
}

TEST(Grid, IsTheChequerboardOfThePaperWithItsPolarDiscs) {
  const auto y = [](double ra, double dec) {
    return static_cast<double>(luminance(seen(sky_direction(ra, dec), 0)));
  };
  const double light = std::max(y(2.5, 2.5), y(7.5, 2.5)),
               dark = std::min(y(2.5, 2.5), y(7.5, 2.5));
  EXPECT_NEAR(light / dark, 4, 1e-3);
  for (int i = 0; i < 72; ++i)
    for (int j = -17; j < 17; ++j) {
      const bool same = (i + j) % 2 == 0;
      EXPECT_NEAR(y(5 * i + 2.5, 5 * j + 2.5), same ? y(2.5, 2.5) : y(7.5, 2.5), 1e-3 * light);
    }
  EXPECT_NEAR(y(10, 88), y(200, -88), 1e-9);
  EXPECT_GT(y(10, 88), light);
  const WorkingRgb pole = seen(sky_direction(0, 89), 0), square = seen(sky_direction(2.5, 2.5), 0);
  EXPECT_GT(pole.r / pole.b, 3 * square.r / square.b) << "2000 K against 8000 K";
}

TEST(Grid, BlurredByItsFootprintKeepsItsMean) {
  const double sharp_light = luminance(seen(sky_direction(2.5, 2.5), 0)),
               sharp_dark = luminance(seen(sky_direction(7.5, 2.5), 0));
  for (const double footprint : {0.8, 10.0})
    EXPECT_NEAR(luminance(seen(sky_direction(33, 21), footprint)), (sharp_light + sharp_dark) / 2,
                0.02 * sharp_light);
}

// The oracle goes all round the direction and looks for another light.
TEST(Grid, IsEvenWhereAllWithinReachHasOneLight) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> logarithm(-4, -1);
  int even = 0, uneven = 0;
  for (int k = 0; k < 2000; ++k) {
    // A third lies near a pole, with its disc.
    V3d d(normal(random), normal(random), normal(random) * (k % 3 == 0 ? 30 : 1));
    d.normalize();
    const double reach = std::pow(10, logarithm(random));
    const float light = seen({d}, 0).g;
    const V3d a = d.cross(std::abs(d.z) < 0.9 ? V3d(0, 0, 1) : V3d(1, 0, 0)).normalized(),
              b = d.cross(a);
    // How far the nearest other light is, as a part of the reach.
    double nearest = 2;
    for (const double part : {0.2, 0.4, 0.6, 0.8, 0.98, 1.02, 1.2, 1.4})
      for (int at = 0; at < 90; ++at) {
        const double angle = at * std::numbers::pi / 45, away = part * reach;
        const V3d there =
            d * std::cos(away) + (a * std::cos(angle) + b * std::sin(angle)) * std::sin(away);
        if (std::abs(seen({there}, 0).g - light) > 0.01f * light) nearest = std::min(nearest, part);
      }
    // Pixels that reach no border at all are not to be sampled for nothing, either.
    const bool is_even = grid_is_even({d}, reach);
    if (nearest < 1) {
      EXPECT_FALSE(is_even) << d.x << ' ' << d.y << ' ' << d.z << ", reach " << reach;
      ++uneven;
    } else if (nearest > 1.3) {
      even += is_even;
    }
  }
  EXPECT_GT(even, 800);
  EXPECT_GT(uneven, 500);
}

}  // namespace
}  // namespace domefall
