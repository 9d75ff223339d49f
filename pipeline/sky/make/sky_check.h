// Whether a sky map lies on the sky as it is said to, by the stars that everybody knows.
#pragma once

#include <string>
#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"
#include "pipeline/sky/maps/orientation.h"
#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// How a map fits the sky if its picture had lain like this.
struct OrientationFit {
  Orientation orientation;
  double stars;  // part of the brightest stars at whose places a point stands out, 0 to 1
  // Rank correlation of its light with the density of the catalogue's stars, -1 to 1.
  double band;
  double clouds;  // part of eight known clouds and galaxies that stand out, 0 to 1
};

enum class SkyVerdict {
  kAgrees,   // as it is said to
  kOther,    // another orientation fits clearly better
  kUnclear,  // it shows neither stars nor a Milky Way that could tell
};

struct SkyCheck {
  SkyVerdict verdict;
  bool by_stars;  // else by the Milky Way
  OrientationFit stated;
  std::vector<OrientationFit> others;  // the best first
};

// Compares the orientation that a map was made with to the 31 others with the frame, the direction of
// longitude, the top and the middle (by quarter turns) changed.  Points of light at the places of the
// 150 brightest stars decide, where there are any: half of them at least, and at least 0.15 more than
// elsewhere.  A picture without stars is judged by its Milky Way, which the density of the catalogue's
// 40,000 brightest stars tells to be there, and by its clouds, which tell it from its mirror images:
// the mean of `band` and `clouds` must be 0.3 at least, and 0.1 more than otherwise.
SkyCheck check_orientation(const SkyMap& map, const Orientation& stated,
                           const StarCatalogue& catalogue);

// The light at a place over the median of that around it.
struct KnownPlace {
  std::string name;
  SkyDirection direction;
  double radius;    // radians
  double contrast;  // of a disc of that radius to a ring of 2.5 times that; 1 where all is dark
};

// The brightest stars that have names, then galaxies and clouds that a sky without stars shows too.
std::vector<KnownPlace> known_places(const SkyMap& map, const StarCatalogue& catalogue);

}  // namespace domefall
