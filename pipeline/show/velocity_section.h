// The keys of a trajectory of type `velocity` that say how fast and where to.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// gamma v against the rain tetrad, from speed or lorentz_factor and direction, as seen from the
// frame of the given celerity.
std::optional<V3d> read_celerity(const Section& trajectory, const Stage& stage, const V3d& frame,
                                 Lookup& lookup);

}  // namespace domefall
