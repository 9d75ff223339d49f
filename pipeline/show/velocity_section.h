// These functions read the keys that give a velocity: how fast, where to, and against which
// observer.
#pragma once

#include "pipeline/show/trajectory_section.h"

namespace domefall {

// Reads the observer near a hole against whom a velocity is given, from `against`, `region` and a
// radius.
std::optional<GivenVelocity> read_frame(const Section& s, std::string_view radius_key = "r");

// Reads gamma v against the observer `frame`, along the axes of frame.tetrad, from `speed` or
// `lorentz_factor` and `direction`.  A direction that is a place on the sky is the one in which
// that observer sees its primary image, so that the place lies dead ahead.
std::optional<V3d> read_own_celerity(const Section& s, const Stage& stage,
                                     const GivenVelocity& frame, Lookup& lookup);

// Reads a trajectory that holds such a velocity, or one that goes evenly in rapidity from one speed
// to another within the segment.
std::optional<Trajectory> read_velocity_trajectory(const Section& s, const Stage& stage,
                                                   const GivenVelocity& frame, Lookup& lookup);

}  // namespace domefall
