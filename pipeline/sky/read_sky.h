// The backgrounds that a show may name: .sky files and panoramas.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// A .sky file, told by how it begins, is mapped; any other file is read as an equirectangular image
// (SkyMap's constructor).  Throws InputError naming the file.
std::shared_ptr<const SkyMap> read_sky(const std::filesystem::path& file);

// Of all that decides what the file looks like, without reading a .sky file whole.
std::string sky_digest(const std::filesystem::path& file);

}  // namespace domefall
