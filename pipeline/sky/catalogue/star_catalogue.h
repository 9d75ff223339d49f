// Stars as the renderer needs them: directions, magnitudes, temperatures, and names to look for.
#pragma once

#include <optional>
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

// Returns a name in lower case without blanks and underscores, so that "Alpha Cen" and "alphacen"
// are one.
std::string folded_star_name(std::string_view name);

// Returns the first star of that folded name.
std::optional<SkyDirection> find_star(const StarCatalogue& catalogue, std::string_view name);

// Returns the name nearest to a misspelt one, for error messages.  Empty if none is nearer than
// a third of its letters (at least two) inserted, deleted or replaced.
std::string nearest_star_name(const StarCatalogue& catalogue, std::string_view name);

}  // namespace domefall
