// The check of a sky map finds out whether the map lies on the sky as it is said to.  It goes by
// well-known stars, clouds and galaxies.
#pragma once

#include <string>
#include <vector>

#include "pipeline/sources/sky/orientation.h"
#include "pipeline/sources/sky/sky_map.h"
#include "pipeline/sources/stars/star_catalogue.h"

namespace domefall {

// The fit says how well a map would agree with the sky if its panorama had lain like this.
struct OrientationFit {
  Orientation orientation;
  double stars;  // share of the brightest stars at whose places a point stands out, 0 to 1
  // This is the rank correlation (Spearman), from -1 to 1, of the map's light with the density of
  // the catalogue's stars.
  double band;
  double clouds;  // share of eight known clouds and galaxies that stand out, 0 to 1
};

enum class SkyVerdict {
  kAgrees,   // the map lies as it is said to
  kOther,    // another orientation fits clearly better
  kUnclear,  // the map shows neither stars nor a Milky Way that could tell
};

struct SkyCheck {
  SkyVerdict verdict;
  bool by_stars;  // otherwise by the Milky Way
  OrientationFit stated;
  std::vector<OrientationFit> others;  // best first
};

// Compares the orientation with which a map was made to the 31 others that differ in frame,
// direction of longitude, top, and middle by quarter turns.
//
// A map has stars if some orientation finds points of light at half of the 150 brightest stars, and
// at 0.3 more of them than another.  The best orientation by `stars` then decides if it is at least
// 0.15 better than the stated one.  A map without stars is judged by its Milky Way, which lies
// where the 40,000 brightest stars are dense, and by clouds, which tell it from its mirror images.
// In that case the mean of `band` and `clouds` must be at least 0.3, and 0.1 more than that of the
// stated orientation.
SkyCheck check_orientation(const SkyMap& map, const Orientation& stated,
                           const StarCatalogue& catalogue);

// The contrast is the map's light at a known place over the median of the light around it.
struct KnownPlace {
  std::string name;
  SkyDirection direction;
  double radius;    // radians
  double contrast;  // of a disc of that radius to a ring of 2.5 times that; 1 if all is dark
};

// Returns the brightest stars that have names, and then galaxies and clouds, which even a sky
// without stars shows.
std::vector<KnownPlace> known_places(const SkyMap& map, const StarCatalogue& catalogue);

}  // namespace domefall
