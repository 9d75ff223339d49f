// The show's `timeline`.
#pragma once

#include "pipeline/show/camera_section.h"
#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads the segments of a `show` that has everything else but its grade already.
std::vector<Segment> read_timeline(const Section& section, const Show& show,
                                   const ShowCamera& camera, Lookup& lookup);

}  // namespace domefall
