// From a show file to a Show.  docs/show-format.md describes the file.
#pragma once

#include <filesystem>

#include "pipeline/show/show.h"

namespace domefall {

// Reads and checks everything: keys, kinds, units, ranges, the files and stars that are named, and
// whether the orbits exist.  Images, catalogues and the grading configuration are looked for, not
// opened; star names alone make it read the naked-eye catalogue.
// Throws InputError with a line for each mistake, in the order of the file (at most 100):
//   shows/infall.yaml:4:12: timeline[0].trajectory.from_r must exceed 0 (units of M), got -3
// and TemporaryError if reading breaks off.
Show read_show(const std::filesystem::path& file);

}  // namespace domefall
