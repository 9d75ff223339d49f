// A GivenVelocity is an observer whose place and four-velocity are simply given.  It is one instant
// of any motion, held.
#pragma once

#include "trajectories/orbit_point.h"

namespace domefall {

struct GivenVelocity {
  Region region = Region::kI;
  Tetrad tetrad = Tetrad::kRain;  // has_tetrad(region, tetrad)
  double r = kFlatSpace;          // above the horizon in I and III, at most it in II and IV
  Celerity<ReferenceTetrad> celerity;
  double l = 0;      // of a wormhole, as in ObserverState
  double theta = 0;  // near a hole that spins, as in OrbitPoint

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return r; }
  bool is_at_rest(const Spacetime& spacetime) const;
};

}  // namespace domefall
