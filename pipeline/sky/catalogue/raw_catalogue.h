// A raw catalogue holds observed quantities, as importers hand them over and as catalogue files
// store them.  The directions and temperatures of star_catalogue.h are made from them when it is
// used.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/sky/catalogue/star_colour.h"
#include "pipeline/sky/catalogue/star_id.h"
#include "trajectories/directions.h"

namespace domefall {

// No star is brighter or fainter than these limits, so a number beyond them is a mistake.
inline constexpr double kBrightestV = -30, kFaintestV = 40;

// A star whose catalogue gives no magnitude has this one.  It lies beyond every limit, so that the
// star is left out unless a correction gives it a magnitude.
inline constexpr float kNoMagnitude = 99;

struct CatalogueStar {
  SkyDirection direction{V3d(1, 0, 0)};  // at the catalogue's epoch
  float pm_ra = 0, pm_dec = 0;           // proper motion (proper_motion.h), mas a year
  float v = 0;                           // magnitude, Johnson V
  float colour = kNoColour;              // star_colour.h
  StarId id = kNoStarId;

  // Importers use these two.  Files do not hold them.
  std::uint32_t hip = 0;    // Hipparcos number, 0 for none; the components of a star may share it
  bool v_is_rough = false;  // V comes from another band, without a colour to convert it by
};

struct StarName {
  std::uint32_t star;  // index into the list of stars
  std::string name;
};

// These lines are for people to read.
struct CatalogueText {
  std::string source, licence;
  std::string made;  // the command by which Domefall made the file
};

// The names are in ascending order of `star`.  A star may have several.
struct RawCatalogue {
  std::vector<CatalogueStar> stars;
  std::vector<StarName> names;
  double epoch = 2000;  // Julian year of the positions
  CatalogueText text;
};

// Sorts the stars, brightest first.  Stars of one magnitude keep their order, and names follow
// their stars.
void sort_by_brightness(RawCatalogue& catalogue);

// Removes the stars fainter than V = `faintest`, and their names.
void keep_brighter(RawCatalogue& catalogue, double faintest);

// Gives the brightest star of each Hipparcos number that number as its identifier.  The other stars
// keep what they have.
void identify_by_hipparcos(std::vector<CatalogueStar>& stars);

}  // namespace domefall
