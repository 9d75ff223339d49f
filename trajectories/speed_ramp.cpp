#include "trajectories/speed_ramp.h"

#include <algorithm>
#include <cmath>

namespace domefall {

OrbitPoint point_at(const SpeedRamp& ramp, double tau) {
  const double part = std::clamp(tau / ramp.duration, 0.0, 1.0);
  const double rapidity = std::lerp(ramp.rapidity_begin, ramp.rapidity_end, part);
  GivenVelocity now = ramp.frame;
  now.celerity = celerity_against(ramp.frame.celerity, ramp.direction * std::sinh(rapidity));
  return point_at(now, tau);
}

}  // namespace domefall
