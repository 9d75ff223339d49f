// Reads a show file, which docs/show-format.md describes.
#pragma once

#include <filesystem>

#include "pipeline/show/show.h"

namespace domefall {

// Reads and checks everything: keys, kinds, units and ranges, the files and stars that are named,
// and whether the orbits exist.  Images, catalogues and the grading configuration must be there,
// but are not opened, except that a star's name needs the naked-eye catalogue.
// Throws InputError with a line for each mistake (at most 100), in the order of the file, such as
//   shows/infall.yaml:4:12: timeline[0].trajectory.from_r must exceed 0 (units of M), got -3
// and TemporaryError with the same lines if all that is wrong is that files are missing or cannot
// be read, or if reading breaks off.
Show read_show(const std::filesystem::path& file);

}  // namespace domefall
