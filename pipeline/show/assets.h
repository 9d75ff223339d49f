// This header names the files that come with Domefall, which are sky maps, star catalogues, a table
// of places on the sky and a grading configuration, and finds them.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

// The standard catalogue has all stars of V <= 9, and the names of the bright ones.
inline constexpr std::string_view kStandardStars = "stars_to_9.stars";
inline constexpr double kStandardLimit = 9, kNakedEyeLimit = 6.5;
// `stars: deepest` looks for this catalogue, which shows/assets/fetch_stars makes.
inline constexpr std::string_view kDeepestStars = "tycho2.stars";
// These maps hold the light of all stars that kStandardStars lacks, and of all that kDeepestStars
// lacks.  The build makes both from the panoramas of the same names (.exr).
inline constexpr std::string_view kMilkyWay = "milky_way.sky";
inline constexpr std::string_view kDeepMilkyWay = "milky_way_deep.sky";
inline constexpr std::string_view kSkyPlaces = "sky_places.csv";
inline constexpr std::string_view kFigures = "figures.csv";  // of constellations
inline constexpr std::string_view kDomeConfig = "dome.ocio";

// Returns the folder that holds these files.  If $DOMEFALL_ASSETS is set, it names the folder.
// Otherwise it is ../share/domefall/assets as seen from the program's folder, which an installed
// Domefall has, or else shows/assets of the source tree.
std::filesystem::path assets_folder();

// Sets the folder that counts as the program's, for a library that another program has loaded, such
// as the Python module.  This function must be called before all others here.
void take_program_folder(const std::filesystem::path& folder);

// Returns the path of one of these files, which need not exist.  Files that the build makes are
// also looked for in the folder `assets` beside the program and in that of the build tree, unless
// $DOMEFALL_ASSETS is set.
std::filesystem::path shipped_asset(std::string_view name);

}  // namespace domefall
