// The keys of a trajectory of type `velocity` that say how fast and where to.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// gamma v against the rain tetrad at radius r, from speed or lorentz_factor and direction, as seen
// from the frame of the given celerity.  A place on the sky is a direction too: the one in which an
// observer of that frame sees it (its primary image), so that it lies dead ahead.
std::optional<V3d> read_celerity(const Section& s, const Stage& stage, double r, const V3d& frame,
                                 Lookup& lookup);

}  // namespace domefall
