// The files that come with Domefall: sky map, star catalogue, places on the sky, grading
// configuration.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

inline constexpr std::string_view kNakedEyeStars = "naked_eye_stars.csv";
inline constexpr std::string_view kSkyPlaces = "sky_places.csv";
inline constexpr std::string_view kMilkyWay = "milky_way.exr";
inline constexpr std::string_view kDomeConfig = "dome.ocio";

// The folder that holds them.  It is $DOMEFALL_ASSETS where that is set; else
// ../share/domefall/assets beside the program's folder, which an installed Domefall has; else
// shows/assets of the source tree.
std::filesystem::path assets_folder();

// The path of one of these files, which need not exist.
std::filesystem::path shipped_asset(std::string_view name);

}  // namespace domefall
