// An AcceleratedPath is a KeyframePath near a hole without spin.  r and the azimuth are those of the
// keys, and the rest of the four-velocity is its normalisation, E = sqrt((dr/dtau)^2 + f (1 + (r
// dphi/dtau)^2)) >= 0 with f = lapse_squared(r).  Outside the hole, and inside the inner horizon of a
// charge, any path is possible.  Between, the rate dr/dtau must be large enough, and negative (rain)
// or positive (outgoing tetrad).  The state is exact to rounding for its r, azimuth and their rates.
// null_time is a quadrature with 1e-13, or what rounding leaves of r - 2 next to a horizon that the
// tetrad does not cross, which is 1e-12/(r - 2) next to r = 2.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/keyframe_path.h"

namespace domefall {

class AcceleratedPath : public KeyframePath {
 public:
  // Takes two keys or more.  The tetrad holds for the whole path.  It is rain in I and II, outgoing
  // in IV and I, and the other two in III and II, IV and III.  Inside an inner horizon, in V, it is
  // rain.  Throws std::domain_error that names the key (counted from 1) and the instant where the
  // path cannot be flown.  The reasons are keys out of order, r not above 0, or a place inside the
  // hole where it would have to be faster than light or turn back.
  explicit AcceleratedPath(const std::vector<PathKey>& keys, Tetrad tetrad = Tetrad::kRain,
                           const Spacetime& spacetime = Schwarzschild{});

  // Returns the point for tau in [begin(), end()], and throws std::domain_error elsewhere.  azimuth
  // is that of the keys, and null_time counts from begin().
  OrbitPoint at(const ProperTime& tau) const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
