// A show may name two kinds of background: .sky files and panoramas.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "pipeline/sources/sky/sky_map.h"

namespace domefall {

// A BackgroundMap is the map of a background.
struct BackgroundMap {
  std::shared_ptr<const SkyMap> map;
  // Set for the cosmic microwave background, as `domefall sky import --cmb` makes it.  The text in
  // the header of the .sky file tells.
  bool is_microwave_background = false;
};

// Opens a .sky file (is_sky_file), or makes a map of an equirectangular image (map_of_panorama).
// Levels of more than `largest_face` texels along an edge are left out.  This serves frames of few
// pixels, because most of the time that an image takes goes into painting its fine levels.  Throws
// InputError naming the file.
BackgroundMap read_sky(const std::filesystem::path& file, int largest_face = kLargestFace);

// Makes no map, but throws as read_sky does where a .sky file cannot be opened or an image cannot
// be decoded.
void try_sky(const std::filesystem::path& file);

// Returns a digest of everything that decides how the sky looks.  It needs only the header of a
// .sky file.
std::string sky_digest(const std::filesystem::path& file);

}  // namespace domefall
