// A show may name two kinds of star catalogue: .stars files and tables.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {

class StarFile;

// Reads the stars of V <= max_magnitude, with their directions in the Julian year `epoch` (`moved`
// in proper_motion.h).  A file that begins as a .stars file does is one.  Any other file is a
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
