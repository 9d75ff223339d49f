// A KerrFlight is that of an observer with engines about a hole that spins, who follows keyframes: r, the
// angle from the axis and the azimuth, that of light which falls, are cubics of proper time between
// them, as in an AcceleratedPath.  Of the four-velocity their rates tell all but A = u^T + u^R:
//
//     f A^2 - 2bA = 1 + Sigma (theta'^2 + sin^2 theta phi'^2)     f = (Delta - a^2 sin^2 theta)/Sigma
//                                                                 b = r' - a sin^2 theta phi'
//
// Outside the ergosphere, where f > 0, any path is possible.  Within, and inside the horizon, it is one
// of positive energy with b < 0: it must move with the hole, or fall.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "trajectories/infinity.h"
#include "trajectories/kerr_motion.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// The proper time, r, theta and azimuth of a key, and their rates by proper time.
struct KerrKey {
  double tau = 0, r = 10, theta = 0, azimuth = 0;
  struct Rates {
    double r, theta, azimuth;
  };
  std::optional<Rates> rates{};
};

// Returns the rates of a motion.
KerrKey::Rates kerr_rates(const KerrHole& hole, double r, double theta,
                          const Celerity<ReferenceTetrad>& u);

class KerrFlight {
 public:
  // Takes two keys or more, outside the inner horizon.  Throws std::domain_error that names the key
  // (counted from 1) and the instant from which the path cannot be flown.
  KerrFlight(const KerrHole& hole, const std::vector<KerrKey>& keys);

  double begin() const;  // proper times of the first and the last key
  double end() const;
  // Returns the point for tau in [begin(), end()], and throws std::domain_error elsewhere.
  OrbitPoint at(const ProperTime& tau) const;
  double birth() const;  // the neighbours of begin() and end(), which still belong to the flight
  double death() const;
  // Returns the first proper time >= after at which r is passed on that leg.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
