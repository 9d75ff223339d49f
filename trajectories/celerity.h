// A Celerity is gamma v, with components along the R, Theta and Phi of an observer's reference
// tetrad.  Its type names the frame that the motion is against, and a plain vector becomes one by
// name only, so that celerities against two frames cannot be mistaken for each other.
#pragma once

#include <cmath>

#include "trajectories/directions.h"

namespace domefall {

struct ReferenceTetrad;  // that of the observer or orbit that holds the celerity
struct RainTetrad;       // rain, or rain of region III, whichever tetrad an observer has
struct RestFrame;        // what rests in r outside a horizon, or in t inside
struct GivenFrame;       // the observer whom a show names to give a speed against

template <class Frame>
struct Celerity : V3d {
  constexpr Celerity() : V3d(0, 0, 0) {}
  constexpr Celerity(double radial, double theta, double phi) : V3d(radial, theta, phi) {}
  constexpr explicit Celerity(const V3d& v) : V3d(v) {}
};

// Returns the Lorentz factor of a celerity.
inline double gamma_of(const V3d& celerity) { return std::sqrt(1 + celerity.length2()); }

// Returns the speed of a celerity of that length, as a part of the speed of light.
inline double speed_of(double celerity) { return celerity / std::hypot(1.0, celerity); }

// Returns the celerity against a frame F of an observer that has the celerity `own` against a frame
// G, which itself has the celerity `frame` against F.  The axes of G are those of F, boosted
// ([Riazuelo] eq. Lambda_cov).  It takes celerities because a speed in double precision holds no
// Lorentz factor beyond 1e8.
template <class F, class G>
Celerity<F> celerity_against(const Celerity<F>& frame, const Celerity<G>& own) {
  return Celerity<F>(own + frame * (gamma_of(own) + frame.dot(own) / (1 + gamma_of(frame))));
}

}  // namespace domefall
