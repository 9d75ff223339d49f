// A star as a catalogue file holds it, and as importers hand it over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/sky/catalogue/star_id.h"
#include "trajectories/directions.h"

namespace domefall {

// Colour: B-V in magnitudes, -2 to 10; or a temperature in kelvin, at least kColdest; or kNoColour.
inline constexpr float kBluest = -2, kReddest = 10, kNoColour = 99, kColdest = 500, kHottest = 1e6F;
// What a star without colour is drawn as: near the median of naked-eye stars.
inline constexpr double kAssumedColour = 0.6;

inline bool is_temperature(float colour) { return colour >= kColdest; }

// Fainter and brighter than any star: beyond them a number is a mistake.
inline constexpr double kBrightestV = -30, kFaintestV = 40;

// Of a star whose catalogue gives no magnitude: beyond every limit, so that it is left out unless a
// correction gives one.
inline constexpr float kNoMagnitude = 99;

struct CatalogueStar {
  SkyDirection direction{V3d(1, 0, 0)};  // at the catalogue's epoch
  float pm_ra = 0, pm_dec = 0;  // proper motion, mas a year; of right ascension, times cos Dec
  float v = 0;                  // Johnson V
  float colour = kNoColour;
  StarId id = kNoStarId;
  // For importers alone; files do not hold them.
  std::uint32_t hip = 0;    // its Hipparcos number, 0 for none; its components may share it
  bool v_is_rough = false;  // from another band, without a colour to convert it
};

struct StarName {
  std::uint32_t star;  // its place in the list
  std::string name;
};

struct CatalogueText {
  std::string source, licence;
  std::string made;  // how
};

// Shapes: names in ascending order of star; one star may have several.
struct RawCatalogue {
  std::vector<CatalogueStar> stars;
  std::vector<StarName> names;
  double epoch = 2000;  // Julian year of the positions
  CatalogueText text;
};

// Where a star stands after so many years, its motion being taken as linear in space and square to the line
// of sight: direction + years * motion, made a unit vector again.  Exact for a star without radial velocity;
// Barnard's star, which comes nearer at 110 km/s, is 0.2 degrees off after 1,000 years.  At a pole,
// right ascension 0 is meant.
SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years);

// Brightest first, equal ones in the order they came in, names after their stars.
void sort_by_brightness(RawCatalogue& catalogue);

// Leaves the stars of V <= faintest, and the names of these.
void keep_brighter(RawCatalogue& catalogue, double faintest);

}  // namespace domefall
