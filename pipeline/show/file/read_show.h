// read_show() reads a show file, which docs/show-format.md describes.
#pragma once

#include <filesystem>
#include <string>

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

// Returns the show in the size and with the overlays that a command line asks for, as resized() and
// parse_overlays() read them; empty texts change nothing.  The title then names the overlays, so that
// its frames are another show's than those without, and neither takes the place of the other unasked.
// Also throws InputError for overlays that a cubemap cannot have.
Show read_show(const std::filesystem::path& file, const std::string& size,
               const std::string& overlays);

}  // namespace domefall
