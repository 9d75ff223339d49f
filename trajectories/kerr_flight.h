// A KerrFlight is a KeyframePath about a hole that spins, whose azimuth is that of light which falls.
// Of the four-velocity the rates tell all but A = u^T + u^R:
//
//     f A^2 - 2bA = 1 + Sigma (theta'^2 + sin^2 theta phi'^2)     f = (Delta - a^2 sin^2 theta)/Sigma
//                                                                 b = r' - a sin^2 theta phi'
//
// Outside the ergosphere, where f > 0, any path is possible.  Within, and inside the horizon, it is one
// of positive energy with b < 0: it must move with the hole, or fall.
#pragma once

#include <memory>
#include <vector>

#include "trajectories/kerr_motion.h"
#include "trajectories/keyframe_path.h"

namespace domefall {

// Sets the rates of a key, by its r and theta, to those of a motion.
void set_kerr_rates(const KerrHole& hole, PathKey& key, const Celerity<ReferenceTetrad>& u);

class KerrFlight : public KeyframePath {
 public:
  // Takes the keys of a KeyframePath.  Throws std::domain_error that names the key (counted from 1)
  // and the instant from which the path cannot be flown, or passes the inner horizon.
  KerrFlight(const KerrHole& hole, const std::vector<PathKey>& keys);

  // Returns the point for tau in [begin(), end()], and throws std::domain_error elsewhere.
  OrbitPoint at(const ProperTime& tau) const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
