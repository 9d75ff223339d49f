// Motion in a wormhole: held with engines, in free fall, and along keyframes with engines.  Lengths
// are in radii of the throat.
//
// Points have the tetrad of rest, with R along growing l, towards region I, on both sides of the
// throat, so that nothing turns where an observer passes.  Of the celerity, x is dl/dtau.  The
// region is I for l >= 0 and III for l < 0, r is the radius of the sphere, and l stands beside it,
// since r is the same on both sides and throughout a cylinder.  null_time is t + l, with t = 0 at
// tau = 0 of a fall and at the first key of a flight.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/spacetime/wormhole.h"
#include "trajectories/infinity.h"
#include "trajectories/keyframe_path.h"
#include "trajectories/orbit_point.h"

namespace domefall {

// A WormholeCircle is an observer who keeps l with engines and circles at an even speed, or rests.
struct WormholeCircle {
  Wormhole wormhole;
  double l = 0;
  double speed = 0;  // of light, 0 to below 1

  OrbitPoint at(const ProperTime& tau) const;
  double held_radius() const { return wormhole.radius(l); }
  bool is_at_rest(const Spacetime&) const { return speed == 0; }
};

// A WormholeFall is free fall.  Nothing pulls in a wormhole: its speed v against rest is the same
// everywhere, and its path is that of light of the same impact parameter b,
//
//     E = 1/sqrt(1 - v^2)   L = b sqrt(E^2 - 1)   dl/dtau = +-sqrt(E^2 - 1 - L^2/r^2).
//
// With b < 1 it passes the throat, and with b > 1 it turns at r = b.  The states are exact for their
// l, which is right to 1e-13 of the way from the turn or the throat.
class WormholeFall {
 public:
  // Takes the place at tau = 0, the speed (above 0, below 1), b from 0 to r(from_l), but not 1, with
  // which it would circle in the throat for ever, and whether it goes towards the throat at first.
  // |from_l| is at most 1e12.  Throws std::domain_error that names the bound.
  WormholeFall(const Wormhole& wormhole, double from_l, double speed, double impact, bool inward);
  // Takes the celerity at from_l, of which along_l is dl/dtau and `around` >= 0.
  static WormholeFall thrown(const Wormhole& wormhole, double from_l, double along_l,
                             double around);

  bool passes() const;
  OrbitPoint at(const ProperTime& tau) const;
  static double birth() { return -kInfinity; }
  static double death() { return kInfinity; }
  // Returns the proper time at which r is passed on that leg.  r = 1 is that at the mouths.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  // Returns the first proper time >= after at which l is passed, or nothing if it never is.
  std::optional<ProperTime> time_at_l(double l, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  WormholeFall() = default;
  static WormholeFall with_celerity(const Wormhole& wormhole, double from_l, double celerity,
                                    double impact, bool inward);

  std::shared_ptr<const Tables> tables_;
};

// A WormholeFlight is a KeyframePath in a wormhole.  Every such path can be flown.  The state is exact
// to rounding for its l, azimuth and their rates; null_time is a quadrature with 1e-13.
class WormholeFlight : public KeyframePath {
 public:
  // Takes the keys of a KeyframePath, whose r is l, of either sign.
  WormholeFlight(const Wormhole& wormhole, const std::vector<PathKey>& keys);

  // Returns the point for tau in [begin(), end()], and throws std::domain_error elsewhere.
  OrbitPoint at(const ProperTime& tau) const;
  // These are those of a KeyframePath, by the r of the wormhole, and by l.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;
  std::optional<ProperTime> time_at_l(double l, const ProperTime& after = -kInfinity) const;
  std::pair<double, double> reach() const;

 private:
  struct Tables;

  std::shared_ptr<const Tables> tables_;
};

}  // namespace domefall
