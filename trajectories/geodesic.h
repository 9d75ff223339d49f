// A Geodesic is any timelike geodesic of the Schwarzschild black hole, through its whole Kruskal
// extension, by proper time.  Energy E and angular momentum L say what it does.  The factories say
// it in the terms that shows use:
//
//   parabolic_orbit.h, hyperbolic_orbit.h    from infinity and back
//   bound_orbit.h                            between two radii for ever
//   infall.h                                 from outside into the hole, and whatever is thrown
//   kruskal_crossing.h                       from the past singularity
//
// tau = 0 and azimuth 0 are at the periastron of orbits that have one, at the apoastron of those
// between two singularities, and at the given place of what is thrown or falls from infinity.
//
// The tetrad of a state is rain throughout for what never was in region IV or is first met outside
// it.  For what comes from IV it is the outgoing one up to its largest r (IV, then I) and rain from
// there on (I, then II), or outgoing throughout if it escapes.  What was thrown outwards is emitted
// in rain from the instant of the throw, and in the outgoing tetrad before it.  E = 0 goes from IV
// to II through r = 2, where neither tetrad is regular.  There the states within |tau| < 4e-6 of it
// are that of 4e-6 before or after, where r = 2 - 2e-12 and the celerity is 1e6.
//
// null_time is 0 at tau = 0, and for E = 0 t is 0 throughout.  For u and v of one geodesic
// v - u = 2 r* where the tetrad changes.
//
// The accuracy was measured over 246 states of tests/reference/orbits.csv (r from 1e-3 to 1e9 M,
// 1e4 periods, whirls of excess 1e-14).  r is right to 2e-13 relative, and azimuth and null time to
// 2e-13 max(1, |value|), beyond what the rounding of tau itself moves them by.  Where tau is one
// double that is much as r -> 0 (1e-8 of r at 1e-3 M) and after many turns.  A tau that time_at()
// gives, or that is counted from birth(), death() or a turning point, keeps the digits of its
// distance from there.  Over 325 states of tests/reference/far_ends.csv, from 1e-6 M to 1e12 M, r
// is right to 7e-15.  What falls after a whirl at the top of its barrier (L or v next to the bound
// of capture) has an azimuth to about 1e-16/sqrt(L_bound/L - 1).  E and L of the emitted states,
// gamma -+ s w_R and r w_Phi, keep to 1e-13 gamma and 1e-15 L.
//
// Proper time, azimuth and null time are quadratures made once by the factory (below 1 ms), and a
// copy shares them.  at() takes 1 to 2 microseconds.  Beyond r = 1e30 M nothing is tabulated.  at()
// throws std::domain_error for a tau that is not in (birth, death) or not in the table.  All
// factories throw it for an orbit of E, L or a periastron of 1e15 or more.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "trajectories/infinity.h"
#include "trajectories/orbit_curve.h"
#include "trajectories/orbit_point.h"

namespace domefall {

class Geodesic {
 public:
  // This is for the factories.  Proper time is counted from the parameter `origin` of the curve.
  // Up to `turn` states are given in the outgoing tetrad, then in rain.
  Geodesic(const OrbitCurve& curve, double origin, double turn,
           double tolerance = kGeodesicTolerance);

  double energy() const;  // per unit of mass, >= 0 (in the mirror's own time, if mirrored)
  double angular_momentum() const;  // M, >= 0
  // These are the proper times of the past and the future singularity, in units of M, or -infinity
  // and infinity without.  They are rounded to a double, and at() counts from the rounded ones.
  double birth() const;
  double death() const;
  double innermost() const;  // r, units of M; 0 for what meets a singularity
  double outermost() const;  // r, units of M, or infinity
  std::pair<double, double> reach() const { return {innermost(), outermost()}; }
  // These return proper time and azimuth from periastron to periastron, or infinity if the orbit is
  // not bound.
  double radial_period() const;
  double azimuth_per_period() const;

  // Returns the point for tau in (birth, death).
  OrbitPoint at(const ProperTime& tau) const;
  // Returns the first proper time >= after at which r is passed on that leg, or nothing if it never
  // is.  Bound orbits pass without end or beginning, and for them -infinity means 0.
  std::optional<ProperTime> time_at(double r, Leg leg, const ProperTime& after = -kInfinity) const;

  // Returns the first proper time >= after of a periastron, or nothing without one.
  std::optional<ProperTime> next_periastron(const ProperTime& after) const;

  // Mirrors the geodesic by t -> -t, which exchanges regions I and III, and their tetrads.
  friend Geodesic mirrored(Geodesic geodesic);

 private:
  static constexpr double kGeodesicTolerance = 1e-14;
  struct Tables;

  std::shared_ptr<const Tables> tables_;
  bool mirrored_ = false;
};

Geodesic mirrored(Geodesic geodesic);

}  // namespace domefall
