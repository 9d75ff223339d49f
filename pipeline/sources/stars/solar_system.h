// The planets, the Sun and the Moon, where they are seen from the Earth, and how bright the planets
// are.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "pipeline/sources/stars/star_catalogue.h"
#include "trajectories/directions.h"

namespace domefall {

enum class SolarBody { kMercury, kVenus, kMars, kJupiter, kSaturn, kUranus, kNeptune, kSun, kMoon };
inline constexpr std::array<std::string_view, 9> kSolarBodyNames{
    "Mercury", "Venus", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune", "Sun", "Moon"};
inline constexpr int kPlanets = 7;  // the first of them

// Returns the body of a name, whose capitals, blanks and '_' do not matter.
std::optional<SolarBody> solar_body(std::string_view name);

// Years are Julian: 2000 is the noon of 1 January 2000 (JD 2451545.0), and a year has 365.25 days,
// by a clock that runs evenly (Terrestrial Time).  -2999 is 3000 BC.
struct YearSpan {
  double first, last;  // both are in it
};

// Returns the years in which a body's place is known: 1800 to 2050 of the Moon, and -2999 to 3000
// of all others.
YearSpan years_of(SolarBody body);

// Returns the direction of a body from the middle of the Earth, J2000, as an atlas of stars has it:
// with the time of light, and without aberration.  `year` is one of years_of().
//
// Planets and Sun follow E. M. Standish's "Keplerian elements for approximate positions of the
// major planets" (JPL Solar System Dynamics): table 1 from 1800 to 2050, and tables 2a and 2b
// before and after.  The Earth is taken to be at its barycentre with the Moon.  The Moon follows
// the largest terms of J. Meeus, Astronomical Algorithms, 2nd ed., table 47.
//
// The largest errors in degrees, against PyEphem 4.1.4 (VSOP87, Chapront's theories of the outer
// planets and the Moon) at 4,000 instants from 1800 to 2050 and 12,000 beyond:
//                Mercury Venus  Mars Jupiter Saturn Uranus Neptune  Sun  Moon
//     1800-2050   0.015  0.03   0.06   0.18   0.23   0.04   0.02   0.01  0.08
//     beyond      0.04   0.09   0.16   0.29   0.47   0.43   0.18   0.03
// From a place on the Earth's surface the Moon stands up to a degree away.
SkyDirection seen_from_earth(SolarBody body, double year);

// Returns V of a planet, by the Astronomical Almanac's formulas since 1984 (Meeus, ch. 41), of
// Saturn with its rings.  The formulas of PyEphem give the same within 0.2, of Mercury 0.5 and of
// Venus 0.26, for phase angles below 130 degrees.  Beyond, where the two are nearly before the Sun,
// they differ by up to 2.5.
double planet_magnitude(SolarBody planet, double year);

// Returns the seven planets as stars with names, of the colours (B-V) that the Explanatory
// Supplement to the Astronomical Almanac (1992) gives in table 15.8.
StarCatalogue planets_as_stars(double year);

}  // namespace domefall
