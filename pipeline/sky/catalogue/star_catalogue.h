// Stars as the renderer needs them: directions, magnitudes, temperatures, and names to look for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

// Stars are placed as in this Julian year unless a show asks for another.
inline constexpr double kCatalogueEpoch = 2000;

struct Star {
  SkyDirection direction;  // J2000
  float v_magnitude;       // Johnson V
  float temperature;       // K, of the blackbody as which it is drawn
};

struct NamedStar {
  std::string name;  // proper name or designation, as in the catalogue
  SkyDirection direction;
};

struct StarCatalogue {
  std::vector<Star> stars;  // sorted by magnitude, brightest first
  std::vector<NamedStar> names;
};

// Returns fewer stars that send the same light, for pictures too small to tell them apart.  The
// `whole` brightest are kept.  Of the next as many, every second is, for two; of twice as many
// beyond them, every fourth, for four; and so on.  The stars that are kept shine for those that are
// not, and are sorted like all others.  `stars` are sorted by magnitude; whole >= 1.
std::vector<Star> thinned(const std::vector<Star>& stars, std::size_t whole);

// Returns a name in lower case without blanks and underscores, so that "Alpha Cen" and "alphacen"
// are one.
std::string folded_star_name(std::string_view name);

}  // namespace domefall
