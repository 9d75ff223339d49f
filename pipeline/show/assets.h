// The files that come with Domefall: sky maps, star catalogue, places on the sky, grading
// configuration.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

// All stars of V <= 9, with the names of the bright ones.
inline constexpr std::string_view kStandardStars = "stars_to_9.stars";
inline constexpr double kStandardLimit = 9, kNakedEyeLimit = 6.5;
// What `stars: deepest` looks for: the file that shows/assets/fetch_stars makes.
inline constexpr std::string_view kDeepestStars = "tycho2.stars";
// The light of all stars that kStandardStars has not, and of all that kDeepestStars has not.  The
// build makes both from the pictures of the same names (.exr).
inline constexpr std::string_view kMilkyWay = "milky_way.sky";
inline constexpr std::string_view kDeepMilkyWay = "milky_way_deep.sky";
inline constexpr std::string_view kSkyPlaces = "sky_places.csv";
inline constexpr std::string_view kDomeConfig = "dome.ocio";

// The folder that holds them.  It is $DOMEFALL_ASSETS where that is set; else
// ../share/domefall/assets beside the program's folder, which an installed Domefall has; else
// shows/assets of the source tree.
std::filesystem::path assets_folder();

// Names the folder that stands for the program's, for a library that another program has loaded, such
// as the Python module.  To be called before all other functions here.
void take_program_folder(const std::filesystem::path& folder);

// The path of one of these files, which need not exist.  What the build makes is also looked for
// in the folder `assets` beside the program and in that of the build tree, unless $DOMEFALL_ASSETS
// is set.
std::filesystem::path shipped_asset(std::string_view name);

}  // namespace domefall
