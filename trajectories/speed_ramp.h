// A SpeedRamp is an observer who gains or loses speed in one direction while the place is held.
// The rapidity changes evenly with proper time, which in flat space is constant acceleration.
#pragma once

#include "trajectories/given_velocity.h"

namespace domefall {

struct SpeedRamp {
  GivenVelocity frame;                          // against whom the speed is measured
  V3d direction{1, 0, 0};                       // unit vector in that frame
  double rapidity_begin = 0, rapidity_end = 0;  // asinh(gamma v), >= 0
  double duration = 1;                          // proper time from one to the other, > 0

  OrbitPoint at(const ProperTime& tau) const;  // before 0 and after `duration` the speed stays
  double held_radius() const { return frame.r; }
};

}  // namespace domefall
