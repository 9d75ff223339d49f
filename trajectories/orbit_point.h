// What a trajectory emits: a point of an orbit in the plane of its motion.
#pragma once

#include "trajectories/observer_state.h"

namespace domefall {

struct OrbitPoint {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;
  double r = kFlatSpace;  // units of M
  double azimuth = 0;     // radians swept in the orbital plane since the start, in the sense of Phi
  V3d celerity{0, 0, 0};  // gamma * velocity against the tetrad, components (R, Theta, Phi);
                          // Phi is the direction of the orbital motion, -Theta the orbit's north
  double null_time = 0;   // v = t + r* (rain) or u = t - r* (outgoing) since the start, units of M
};

}  // namespace domefall
