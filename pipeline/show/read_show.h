// read_show() reads a show file, which docs/show-format.md describes.
#pragma once

#include <filesystem>

#include "pipeline/show/show.h"

namespace domefall {

// Reads and checks everything: keys, kinds, units and ranges, the files and stars that are named,
// and whether the orbits exist.  Images, catalogues and the grading configuration must be there,
// but are not opened, except that the name of a place on the sky needs the standard catalogue and
// the table of places (lookup.h).  Throws InputError with a line for each mistake (at most 100), in
// the order of the file, such as
//   shows/infall.yaml:4:12: timeline[0].trajectory.from_r must exceed 0 (units of M), got -3
// If all that is wrong is that files are missing or cannot be read, or if reading breaks off, it
// throws TemporaryError with the same lines instead.
Show read_show(const std::filesystem::path& file);

}  // namespace domefall
