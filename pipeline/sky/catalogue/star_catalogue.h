// A star catalogue has what the renderer needs of stars: directions, magnitudes, temperatures, and
// names to look for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
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

// Calls keep(star, count) for fewer stars that send the light of all, for frames too small to tell
// them apart.  `star` is the number of a star in a list that is sorted by magnitude, brightest
// first, and `count` is the number of stars whose light it gets.  The `whole` brightest stars are
// kept as they are.  Of the next `whole` stars every second is kept for two, of the 2 `whole` stars
// beyond them every fourth for four, and so on.  whole >= 1.
template <typename Keep>
void thin_out(std::size_t stars, std::size_t whole, Keep keep) {
  for (std::size_t k = 0; k < std::min(whole, stars); ++k) keep(k, std::size_t{1});
  // Stars from `first` to twice `first` stand for `step` stars each.  The kept star is the middle
  // one of its step.
  for (std::size_t first = whole, step = 2; first < stars; first *= 2, step *= 2)
    for (std::size_t k = first + step / 2; k < std::min(2 * first, stars); k += step) keep(k, step);
}

// This value of `whole` keeps every star as it is.
inline constexpr std::size_t kAllWhole = std::numeric_limits<std::size_t>::max();

// Returns `star` with the light of `count` such stars.
Star standing_for(Star star, std::size_t count);

// Sorts stars by magnitude, brightest first.  Stars of one magnitude keep their order.
void sort_by_magnitude(std::vector<Star>& stars);

// Returns a name in lower case without blanks and underscores, so that "Alpha Cen" and "alphacen"
// are the same name.
std::string folded_star_name(std::string_view name);

}  // namespace domefall
