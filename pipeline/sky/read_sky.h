// The backgrounds that a show may name: .sky files and panoramas.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// Opens a .sky file (is_sky_file), or makes a map of an equirectangular image (map_of_panorama).
// Throws InputError naming the file.
std::shared_ptr<const SkyMap> read_sky(const std::filesystem::path& file);

// Returns a digest of what decides how the sky looks.  A .sky file is not read whole for it.
std::string sky_digest(const std::filesystem::path& file);

}  // namespace domefall
