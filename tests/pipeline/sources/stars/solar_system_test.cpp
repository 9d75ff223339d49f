// Tests of the places of planets, Sun and Moon: by events that everybody saw, and against PyEphem
// 4.1.4, which computes them from VSOP87 and Chapront's theories.
#include "pipeline/sources/stars/solar_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trajectories/degree.h"
#include "trajectories/equatorial.h"

namespace domefall {
namespace {

double julian_year(double julian_date) { return 2000 + (julian_date - 2451545) / 365.25; }

double degrees_between(const SkyDirection& a, const SkyDirection& b) {
  return 2 * std::asin(std::min(1.0, (a.v - b.v).length() / 2)) / kDegree;
}

double degrees_between(SolarBody a, SolarBody b, double year) {
  return degrees_between(seen_from_earth(a, year), seen_from_earth(b, year));
}

TEST(SolarSystem, HasTheMeetingsThatWereSeen) {
  using enum SolarBody;
  // 21 December 2020, 18:20 UT: 0.102 degrees.
  EXPECT_NEAR(degrees_between(kJupiter, kSaturn, julian_year(2459205.264)), 0.102, 0.05);
  // 16 July 1623 (Gregorian), 22:00 UT: 0.086 degrees, by tables 2a and 2b.
  EXPECT_NEAR(degrees_between(kJupiter, kSaturn, julian_year(2314045.417)), 0.086, 0.05);
  // 6 June 2012, 01:30 UT: Venus passes before the Sun, 554" from its middle.
  EXPECT_NEAR(degrees_between(kVenus, kSun, julian_year(2456084.5633)), 554 / 3600.0, 0.01);
  // 11 November 2019, 15:20 UT: Mercury does, 76" from it.
  EXPECT_NEAR(degrees_between(kMercury, kSun, julian_year(2458799.1397)), 76 / 3600.0, 0.01);
  // 28 August 2003, 18:00 UT: Mars stands opposite, and is brighter than for 60,000 years.
  const double opposition = julian_year(2452880.25);
  EXPECT_NEAR(degrees_between(kMars, kSun, opposition), 173.4, 0.1);
  EXPECT_NEAR(planet_magnitude(kMars, opposition), -2.9, 0.05);
  // 11 August 1999, 11:03 UT: an eclipse, at which the Moon is 0.495 degrees from the Sun as seen
  // from the middle of the Earth.
  EXPECT_NEAR(degrees_between(kMoon, kSun, julian_year(2451401.9611)), 0.495, 0.03);
}

TEST(SolarSystem, AgreesWithOtherTheories) {
  struct Place {
    double year, ra_deg, dec_deg, v;
  };
  // The errors that the header states.
  constexpr double kModern[]{0.015, 0.03, 0.06, 0.18, 0.23, 0.04, 0.02, 0.01, 0.08};
  constexpr double kLong[]{0.04, 0.09, 0.16, 0.29, 0.47, 0.43, 0.18, 0.03};
  // In 1834.6 Mercury is a crescent, of which magnitudes are uncertain.
  constexpr double kMagnitudes[]{1, 0.26, 0.2, 0.2, 0.06, 0.03, 0.03};
  const auto compare = [&](std::size_t body, const Place& p, double tolerance) {
    const auto b = static_cast<SolarBody>(body);
    const auto told = [&] {
      return std::string(kSolarBodyNames[body]) + " in " + std::to_string(p.year);
    };
    EXPECT_LT(degrees_between(seen_from_earth(b, p.year), sky_direction(p.ra_deg, p.dec_deg)),
              tolerance)
        << told();
    if (body < kPlanets) {
      EXPECT_NEAR(planet_magnitude(b, p.year), p.v, kMagnitudes[body]) << told();
    }
  };
  constexpr Place kPlaces[9][4]{{{1834.6, 134.000, 12.535, 3.48},
                                 {2026.9, 222.531, -14.160, -0.51},
                                 {-6.25, 215.092, -15.198, -0.24},
                                 {2800.5, 114.199, 23.401, -0.71}},
                                {{1834.6, 175.309, 2.939, -3.92},
                                 {2026.9, 203.450, -9.070, -4.44},
                                 {-6.25, 172.678, 4.464, -3.86},
                                 {2800.5, 132.708, 17.038, -4.47}},
                                {{1834.6, 65.283, 20.708, 0.67},
                                 {2026.9, 152.410, 13.675, 0.57},
                                 {-6.25, 150.343, 13.603, 1.56},
                                 {2800.5, 169.665, 5.106, 1.12}},
                                {{1834.6, 67.979, 21.076, -2.06},
                                 {2026.9, 148.677, 13.531, -2.02},
                                 {-6.25, 338.793, -10.526, -2.59},
                                 {2800.5, 196.460, -5.606, -1.95}},
                                {{1834.6, 189.412, -1.546, 0.98},
                                 {2026.9, 8.155, 0.682, 0.68},
                                 {-6.25, 2.877, -1.425, 0.56},
                                 {2800.5, 113.979, 21.695, 0.15}},
                                {{1834.6, 329.797, -13.134, 5.71},
                                 {2026.9, 61.301, 20.667, 5.58},
                                 {-6.25, 357.508, -1.975, 5.74},
                                 {2800.5, 141.628, 15.765, 5.55}},
                                {{1834.6, 304.317, -19.401, 7.85},
                                 {2026.9, 1.766, -0.763, 7.85},
                                 {-6.25, 237.398, -18.396, 8.00},
                                 {2800.5, 250.707, -20.677, 7.88}},
                                {{1834.6, 138.876, 15.929, 0},
                                 {2026.9, 241.038, -20.770, 0},
                                 {-6.25, 199.483, -8.333, 0},
                                 {2800.5, 96.276, 23.212, 0}},
                                {{1834.6, 165.211, 11.647, 0}, {2026.9, 77.194, 27.482, 0}}};
  for (std::size_t body = 0; body < 9; ++body) {
    const auto& [old, now, before, after] = kPlaces[body];
    for (const Place& p : {old, now}) compare(body, p, kModern[body]);
    if (body < 8)
      for (const Place& p : {before, after}) compare(body, p, kLong[body]);
  }
}

// The tables meet within the sum of their errors, so that no number of one of them is misplaced.
TEST(SolarSystem, HasNoJumpWhereItsTablesMeet) {
  for (std::size_t body = 0; body <= kPlanets; ++body)
    for (const double year : {1800.0, 2050.0}) {
      const auto b = static_cast<SolarBody>(body);
      const double beyond = std::nextafter(year, year < 1900 ? 0 : 9999);
      EXPECT_LT(degrees_between(seen_from_earth(b, year), seen_from_earth(b, beyond)), 0.45)
          << kSolarBodyNames[body] << " in " << year;
    }
}

TEST(SolarSystem, IsKnownByNameAndYear) {
  EXPECT_EQ(solar_body("jupiter"), SolarBody::kJupiter);
  EXPECT_EQ(solar_body("Sun"), SolarBody::kSun);
  EXPECT_EQ(solar_body("Earth"), std::nullopt);
  EXPECT_EQ(solar_body(""), std::nullopt);
  EXPECT_EQ(years_of(SolarBody::kMoon).first, 1800);
  EXPECT_EQ(years_of(SolarBody::kMars).last, 3000);
  for (const double year : {-2999.0, 3000.0})
    for (std::size_t body = 0; body <= kPlanets; ++body)
      EXPECT_NEAR(seen_from_earth(static_cast<SolarBody>(body), year).v.length(), 1, 1e-14);
}

TEST(SolarSystem, PlanetsAreStarsWithNames) {
  const StarCatalogue planets = planets_as_stars(2020.9726);
  ASSERT_EQ(planets.stars.size(), 7U);
  ASSERT_EQ(planets.names.size(), 7U);
  // Venus is the brightest, as nearly always, and Neptune the faintest.
  EXPECT_NEAR(planets.stars.front().v_magnitude, -3.9, 0.1);
  EXPECT_EQ(planets.stars.front().direction.v, planets.names[1].direction.v);
  EXPECT_EQ(planets.names[1].name, "Venus");
  EXPECT_NEAR(planets.stars.back().v_magnitude, 7.9, 0.1);
  EXPECT_GT(planets.stars.back().temperature, planets.stars.front().temperature);
}

}  // namespace
}  // namespace domefall
