// Stars as the renderer needs them, read from a catalogue file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trajectories/directions.h"

namespace domefall {

struct Star {
  SkyDirection direction;  // J2000
  float v_magnitude;       // Johnson V
  float temperature;       // kelvin, of the blackbody it is drawn as
};

struct NamedStar {
  std::string name;  // proper name or designation, as in the catalogue
  SkyDirection direction;
};

struct StarCatalogue {
  std::vector<Star> stars;  // sorted by magnitude, brightest first
  std::vector<NamedStar> names;
};

// Effective temperature (K) from B-V: Ballesteros 2012 (EPL 97, 34008), for blackbodies.
// Domain clamped to -0.4 <= B-V <= 2.0 (22,000 K to 3,170 K).
double temperature_from_b_v(double b_v);

// Julian year for which positions are given unless a catalogue says otherwise.
inline constexpr double kCatalogueEpoch = 2000;

// Reads the stars of V <= max_magnitude, where they stand in the Julian year `epoch` (proper motion as
// `moved`, star_record.h).  The file is one of two kinds, told apart by how it begins:
//
// - a *.stars file (star_file.h), of which only the stars wanted and their names are read: all 2.5 million
//   of Tycho-2 in 0.1 s of CPU time.  Throws InputError with file and byte where it is damaged;
// - a CSV with the columns ra_deg, dec_deg (J2000), v_mag and b_v, and perhaps name, designation,
//   pm_ra_mas_yr (times cos Dec) and pm_dec_mas_yr; others and '#' lines are ignored; the names of all its
//   stars are kept.  Throws InputError with file and line where a row is damaged.
//
// A star without colour is taken to have B-V = 0.6.
StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude,
                                  double epoch = kCatalogueEpoch);

// What tells a *.stars file from every other one, from its header alone; nothing for other files.  Throws
// InputError as read_star_catalogue.
std::optional<std::string> star_file_fingerprint(const std::filesystem::path& file);

// By proper name or designation, ignoring case and spaces.
std::optional<SkyDirection> find_star(const StarCatalogue& catalogue, std::string_view name);

// The catalogue's name nearest to a misspelt one, for error messages; empty if none is near.
std::string nearest_star_name(const StarCatalogue& catalogue, std::string_view name);

}  // namespace domefall
