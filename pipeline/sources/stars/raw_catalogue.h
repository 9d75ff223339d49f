// A raw catalogue holds observed quantities, as importers hand them over and as catalogue files
// store them.  The directions and temperatures of star_catalogue.h are made from them when it is
// used.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/sources/stars/star_colour.h"
#include "trajectories/directions.h"

namespace domefall {

// A star identifier is the star's number in the catalogue that named it, in 32 bits.  The two upper bits say which catalogue it is: none, Hipparcos, Henry Draper or Tycho.  The lower
// ones are the star's number in it.
using StarId = std::uint32_t;

inline constexpr StarId kNoStarId = 0;

// The numbers of Hipparcos end here, and so do those of the Henry Draper Catalogue with its
// Extension.
inline constexpr double kLastHip = 120416, kLastHd = 359083;

// These functions make an identifier from a number of 1 to 2^30 - 1.
StarId hipparcos_id(std::uint32_t number);
StarId henry_draper_id(std::uint32_t number);
// By the ReadMe of I/259 (Hog et al. 2000), regions are 1 to 9537, numbers 1 to 12121 and
// components 1 to 4.
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component);

// Returns the identifier of a name such as "HIP 32349", "HD 48915" or "TYC 5949-2777-1", in any case
// and with any blanks.  Returns nothing for other text and for numbers out of range.
std::optional<StarId> parse_star_id(std::string_view text);

// No star is brighter or fainter than these limits, so a number beyond them is a mistake.
inline constexpr double kBrightestV = -30, kFaintestV = 40;

// A star whose catalogue gives no magnitude has this one.  It lies beyond every limit, so that the
// star is left out unless a correction gives it a magnitude.
inline constexpr float kNoMagnitude = 99;

struct CatalogueStar {
  SkyDirection direction{V3d(1, 0, 0)};  // at the catalogue's epoch
  float pm_ra = 0, pm_dec = 0;           // proper motion (moved), mas a year
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

// A greater proper motion (mas a year) is a mistake.  Barnard's star, the fastest, has 1.04e4.
inline constexpr double kFastest = 1e5;

// Returns the direction of a star after some Julian years, forwards or backwards.  `pm_ra` and
// `pm_dec` are its proper motion in mas a year, and the one in right ascension is multiplied by cos
// Dec.  The star moves straight on and square to the line of sight, so the result is direction +
// years * motion, made a unit vector.  That is exact for a star without radial velocity.  Barnard's
// star, which approaches at 110 km/s, is 0.2 degrees off after 1,000 years.  At a pole, where east
// is undefined, the direction counts as one of right ascension 0.
SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years);

}  // namespace domefall
