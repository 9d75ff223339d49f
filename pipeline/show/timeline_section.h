// The section `timeline` of a show lists its segments.
#pragma once

#include "pipeline/show/camera_section.h"
#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads `fade_in_s` and `fade_out_s` of a show, a segment or a title.
Fades read_fades(const Section& section);
// Reports fades that together last longer than the show, segment or title which they begin and end.
// `of` is its name in the message ("the show").
void check_fades(const Section& section, const Fades& fades, double duration, const char* of);

// Reads the segments of a `show` that has everything else already, except for its titles, its
// output and the settings of its dome.
std::vector<Segment> read_timeline(const Section& section, const Show& show,
                                   const ShowCamera& camera, Lookup& lookup);

}  // namespace domefall
