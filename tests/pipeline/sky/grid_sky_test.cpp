#include "pipeline/sky/grid_sky.h"

#include <gtest/gtest.h>

#include "trajectories/equatorial.h"

namespace domefall {
namespace {

TEST(Grid, IsTheChequerboardOfThePaperWithItsPolarDiscs) {
  const auto y = [](double ra, double dec) {
    return static_cast<double>(luminance(grid_light(sky_direction(ra, dec), 0, 1)));
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
  const WorkingRgb pole = grid_light(sky_direction(0, 89), 0, 1),
                   square = grid_light(sky_direction(2.5, 2.5), 0, 1);
  EXPECT_GT(pole.r / pole.b, 3 * square.r / square.b) << "2000 K against 8000 K";
}

TEST(Grid, BlurredByItsFootprintKeepsItsMean) {
  const double sharp_light = luminance(grid_light(sky_direction(2.5, 2.5), 0, 1)),
               sharp_dark = luminance(grid_light(sky_direction(7.5, 2.5), 0, 1));
  for (const double footprint : {0.8, 10.0})
    EXPECT_NEAR(luminance(grid_light(sky_direction(33, 21), footprint, 1)),
                (sharp_light + sharp_dark) / 2, 0.02 * sharp_light);
}

}  // namespace
}  // namespace domefall
