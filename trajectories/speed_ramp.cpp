#include "trajectories/speed_ramp.h"

#include <algorithm>
#include <cmath>

namespace domefall {

OrbitPoint SpeedRamp::at(const ProperTime& tau) const {
  const double part = std::clamp(double(tau) / duration, 0.0, 1.0);
  const double rapidity = std::lerp(rapidity_begin, rapidity_end, part);
  GivenVelocity now = frame;
  now.celerity =
      celerity_against(frame.celerity, Celerity<GivenFrame>(direction * std::sinh(rapidity)));
  return now.at(tau);
}

}  // namespace domefall
