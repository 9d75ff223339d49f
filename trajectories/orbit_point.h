// An OrbitPoint is what a trajectory emits, a point of an orbit in the plane of its motion.
#pragma once

#include "trajectories/double_double.h"
#include "trajectories/observer_state.h"

namespace domefall {

// A Leg is the part of an orbit on which r falls or grows.
enum class Leg { kInward, kOutward };

struct OrbitPoint {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;
  double r = kFlatSpace;  // units of M
  double azimuth = 0;     // radians swept in the orbital plane since the start, in the sense of Phi
  // Phi is the direction of the orbital motion, and -Theta the orbit's north.
  Celerity<ReferenceTetrad> celerity;
  // This is v = t + r* (rain) or u = t - r* (outgoing), with r* = r + 2 ln|r/2 - 1|, in units of M.
  // For the mirrored tetrads it is taken after t -> -t.  t counts from an origin of the
  // trajectory's own, the same for its tetrads, so v - u = 2 r* where it changes from one to the
  // other.
  DoubleDouble null_time{};
  int universe = 0;  // of those that follow each other through a charged hole
  double l = 0;      // of a wormhole, as in ObserverState
  // Near a hole that spins this is the angle from its axis, along which Theta points, and azimuth is
  // that about the axis in the coordinates of light that falls.
  double theta = 0;
};

}  // namespace domefall
