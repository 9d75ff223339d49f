// Reads markers and cuts from a timeline of OpenTimelineIO, which other programs have edited.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/show/show.h"

namespace domefall {

// Returns, in the order of their instants, the markers of a timeline, of its tracks and of what is
// in them, and the beginnings of its clips under their names.  An instant counts from the beginning
// of the timeline.  Of several things of one name, the later ones get a number behind it; what has
// no name gets one by its kind, "cut" or "marker".  Throws InputError, with the place in the file,
// for what is no such timeline, and for nested tracks, whose times are not followed.
std::vector<Marker> read_otio_markers(const std::filesystem::path& file);

}  // namespace domefall
