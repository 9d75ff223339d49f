// A star catalogue has what the renderer needs of stars: directions, magnitudes, temperatures, and
// names to look for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// The directions of stars are those in this Julian year unless a show asks for another.
inline constexpr double kCatalogueEpoch = 2000;

struct Star {
  SkyDirection direction;  // J2000
  float v_magnitude;       // Johnson V
  float temperature;       // K, of the blackbody that it is drawn as
};

struct NamedStar {
  std::string name;  // proper name or designation, as in the catalogue
  SkyDirection direction;
};

struct StarCatalogue {
  std::vector<Star> stars;  // sorted by magnitude, brightest first
  std::vector<NamedStar> names;
};

// Returns fewer stars that send the same light, for frames too small to tell them apart.  It
// keeps the `whole` brightest stars.  Of the next `whole` stars it keeps every second, which gets
// the light of two.  Of the 2 `whole` stars beyond them it keeps every fourth, which gets the light
// of four, and so on.  `stars` are sorted by magnitude, and so is the result.  whole >= 1.
std::vector<Star> thinned(const std::vector<Star>& stars, std::size_t whole);

// Returns a name in lower case without blanks and underscores, so that "Alpha Cen" and "alphacen"
// are the same name.
std::string folded_star_name(std::string_view name);

}  // namespace domefall
