// A star catalogue has what the renderer needs of stars: directions, magnitudes, temperatures, and
// names to look for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
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

class StarFile;

// A show may name two kinds of star catalogue: .stars files and tables.
//
// Reads the stars of V <= max_magnitude, with their directions in the Julian year `epoch` (`moved`
// in raw_catalogue.h).  A file that begins as a .stars file does is one.  Any other file is a
// table.
//
// - From a .stars file (star_file.h) only the wanted stars and their names are read.  All 2.5
//   million of Tycho-2 take 0.1 s of CPU time.  Throws InputError with file and byte where it is
//   damaged.
// - A table (csv_file.h) has the columns ra_deg, dec_deg (J2000), v_mag and b_v.  It may have name,
//   designation, pm_ra_mas_yr (times cos Dec) and pm_dec_mas_yr.  Other columns are ignored.  The
//   names of all its stars are kept.  Throws InputError with file and line where a row is damaged.
//
// A star without colour is drawn as one of kAssumedColour.  All stars but the `whole` brightest are
// thinned out (thin_out), which leaves the names as they are.
StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude,
                                  double epoch = kCatalogueEpoch, std::size_t whole = kAllWhole);

// Reads the stars of a .stars file that is open already.  Also throws InputError, with the byte,
// where a record holds no unit vector or a number out of its range.
StarCatalogue stars_of(const StarFile& file, double max_magnitude, double epoch,
                       std::size_t whole = kAllWhole);

// Returns V of the stars of V <= max_magnitude, ascending.  Of a .stars file nothing else is looked
// at.  Throws InputError as read_star_catalogue does.
std::vector<float> star_magnitudes(const std::filesystem::path& file, double max_magnitude);

// Returns digits that tell a .stars file from every other, which it takes from the header alone.
// Returns nothing for another kind of file.  Throws InputError as read_star_catalogue does.
std::optional<std::string> star_file_fingerprint(const std::filesystem::path& file);

// These functions return what a .stars file says about its stars without reading them: V of the
// faintest, and how many are at least as bright as `max_magnitude`.  They return nothing for
// another kind of file.  Both throw InputError as read_star_catalogue does.
std::optional<double> star_file_faintest(const std::filesystem::path& file);
std::optional<std::size_t> star_file_count(const std::filesystem::path& file, double max_magnitude);

}  // namespace domefall
