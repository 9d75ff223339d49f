// An AcceleratedPath is that of an observer with engines, who follows keyframes.  Between them r
// and azimuth are cubics of proper time, once continuously differentiable.  The rest of the
// four-velocity is its normalisation, E = sqrt((dr/dtau)^2 + f (1 + (r dphi/dtau)^2)) >= 0 with f =
// lapse_squared(r).  Outside the hole, and inside the inner horizon of a charge, any path is
// possible.  Between, the rate dr/dtau must be large enough, and negative (rain) or positive
// (outgoing tetrad).  A rate that a key does not give is chosen so that
// the path does not overshoot the keys (Fritsch and Butland's harmonic mean; 0 at a key that is an
// extreme).  The state is exact to rounding for its r, azimuth and their rates.  null_time is a
// quadrature with 1e-13, or what rounding leaves of r - 2 next to a horizon that the tetrad does
// not cross, which is 1e-12/(r - 2) next to r = 2.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/spacetime/spacetime.h"
#include "trajectories/infinity.h"
#include "trajectories/orbit_point.h"

namespace domefall {

struct PathKey {
  double tau = 0;                                     // units of M, growing from key to key
  double r = 0;                                       // units of M, > 0
  double azimuth = 0;                                 // radians; may go back
  std::optional<double> radial_rate = std::nullopt;   // dr/dtau
  std::optional<double> azimuth_rate = std::nullopt;  // dphi/dtau, radians per M
};

class AcceleratedPath {
 public:
  // Takes two keys or more.  The tetrad holds for the whole path.  It is rain in I and II, outgoing
  // in IV and I, and the other two in III and II, IV and III.  Inside an inner horizon, in V, it is
  // rain.  Throws std::domain_error that names
  // the key (counted from 1) and the instant where the path cannot be flown.  The reasons are keys
  // out of order, r not above 0, or a place inside the hole where it would have to be faster than
  // light or turn back.
  explicit AcceleratedPath(const std::vector<PathKey>& keys, Tetrad tetrad = Tetrad::kRain,
                           const Spacetime& spacetime = Schwarzschild{});

  double begin() const;  // proper times of the first and the last key
  double end() const;
  // Returns the point for tau in [begin(), end()], and throws std::domain_error elsewhere.  azimuth
  // is that of the keys, and null_time counts from begin().
  OrbitPoint at(const ProperTime& tau) const;
  // These return the neighbours of begin() and end(), which still belong to the path.
  double birth() const;
  double death() const;
  // Returns the first proper time >= after at which r is passed on that leg, or nothing if it never
  // is.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  // Returns the least and the largest r, to a few parts in 1e5 of the path's extent.
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
