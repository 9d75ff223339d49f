#include "trajectories/equatorial.h"

#include <gtest/gtest.h>

namespace domefall {
namespace {

TEST(Equatorial, TheAxesAreTheEquinoxSixHoursAndThePole) {
  EXPECT_LT((sky_direction(0, 0).v - V3d(1, 0, 0)).length(), 1e-15);
  EXPECT_LT((sky_direction(90, 0).v - V3d(0, 1, 0)).length(), 1e-15);
  EXPECT_LT((sky_direction(123, 90).v - V3d(0, 0, 1)).length(), 1e-15);
}

TEST(Equatorial, APlaceComesBackWithItsRightAscensionFrom0To360) {
  for (const double ra : {0.5, 89.0, 181.0, 266.417, 359.9})
    for (const double dec : {-89.9, -29.008, 0.0, 61.5}) {
      const Equatorial place = equatorial(sky_direction(ra, dec));
      EXPECT_NEAR(place.ra_deg, ra, 1e-11);  // 1e-15 of a turn over cos(89.9 deg)
      EXPECT_NEAR(place.dec_deg, dec, 1e-13);
    }
  EXPECT_NEAR(equatorial(sky_direction(-30, 10)).ra_deg, 330, 1e-12);
}

TEST(Equatorial, AtThePolesTheDeclinationIsExact) {
  EXPECT_EQ(equatorial({V3d(0, 0, 1)}).dec_deg, 90);
  EXPECT_EQ(equatorial({V3d(0, 0, -1)}).dec_deg, -90);
  EXPECT_EQ(equatorial({V3d(0, 0, 1)}).ra_deg, 0);
}

}  // namespace
}  // namespace domefall
