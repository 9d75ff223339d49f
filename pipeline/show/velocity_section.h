// The keys of a trajectory of type `velocity` that say how fast and where to.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// The observer near a hole against whom a velocity is given, by r, region and against.
std::optional<GivenVelocity> read_frame(const Section& s, std::string_view radius_key = "r");

// gamma v against the observer `frame` and against frame.tetrad, from speed or lorentz_factor and direction, as seen by the observer
// `frame`.  A place on the sky is a direction too: the one in which that observer sees it (its
// primary image), so that it lies dead ahead.
std::optional<V3d> read_own_celerity(const Section& s, const Stage& stage,
                                     const GivenVelocity& frame, Lookup& lookup);

// The same of an instant held, or, of two speeds, of what goes evenly from the one to the other in the
// segment: against frame.tetrad.
std::optional<Trajectory> read_velocity_trajectory(const Section& s, const Stage& stage,
                                                   const GivenVelocity& frame, Lookup& lookup);

}  // namespace domefall
