// The backgrounds that a show may name: .sky files and panoramas.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// Opens a .sky file (is_sky_file), or makes a map of an equirectangular image (map_of_panorama).
// Finer levels than those with `largest_face` texels along an edge are left out, which is for
// frames of few pixels: painting them is most of the time that an image takes.  Throws InputError
// naming the file.
std::shared_ptr<const SkyMap> read_sky(const std::filesystem::path& file,
                                       int largest_face = kLargestFace);

// Throws as read_sky does where a .sky file cannot be opened or an image cannot be decoded, but makes
// no map.
void try_sky(const std::filesystem::path& file);

// Whether the file is a .sky file of the cosmic microwave background, as `domefall sky import
// --cmb` makes it and says in its header's text.
bool is_microwave_background(const std::filesystem::path& file);

// Returns a digest of what decides how the sky looks.  A .sky file is not read whole for it.
std::string sky_digest(const std::filesystem::path& file);

}  // namespace domefall
