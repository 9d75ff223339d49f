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

// Reads a CSV with the columns ra_deg, dec_deg, v_mag, b_v, name and designation (others ignored;
// '#' lines are comments; an empty b_v is taken as 0.6).  Keeps stars with V <= max_magnitude.
// Throws InputError with file and line where a row is damaged.
StarCatalogue read_star_catalogue(const std::filesystem::path& file, double max_magnitude);

// By proper name or designation, ignoring case and spaces.
std::optional<SkyDirection> find_star(const StarCatalogue& catalogue, std::string_view name);

// The catalogue's name nearest to a misspelt one, for error messages; empty if none is near.
std::string nearest_star_name(const StarCatalogue& catalogue, std::string_view name);

}  // namespace domefall
