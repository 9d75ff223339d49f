// The files that come with Domefall: sky map, star catalogue, grading configuration.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

inline constexpr std::string_view kNakedEyeStars = "naked_eye_stars.csv";
inline constexpr std::string_view kMilkyWay = "milky_way.exr";
inline constexpr std::string_view kDomeConfig = "dome.ocio";

// The folder they are in: $DOMEFALL_ASSETS where set; else ../share/domefall/assets beside the
// program's folder, if it exists (an installed Domefall); else shows/assets of the source tree.
std::filesystem::path assets_folder();

// Whether the file exists is the caller's question.
std::filesystem::path shipped_asset(std::string_view name);

}  // namespace domefall
