// What moves about a hole that spins, at one place: its four-velocity along the axes of the reference
// tetrad, with T = l + n/2, R = l - n/2, n = -d/dr and l = [(r^2 + a^2) d/dv + a d/dphi + (Delta/2) d/dr]
// /Sigma in the coordinates of light that falls, and for each unit of mass the constants of its free
// motion: the energy E, the angular momentum L about the axis, and Carter's K = Q + (L - a E)^2.
#pragma once

#include <optional>

#include "pipeline/spacetime/kerr.h"
#include "trajectories/celerity.h"

namespace domefall {

struct KerrMotion {
  double energy, excess, momentum, carter;  // E, E^2 - 1, L, K
  Celerity<ReferenceTetrad> celerity;
};
// Returns those of what moves with a celerity against the reference tetrad.  theta is 0 to pi.
KerrMotion kerr_motion(const KerrHole& hole, double r, double theta,
                       const Celerity<ReferenceTetrad>& u);
// Returns that of given constants, with the signs of dr and dtheta.  What is outside the bounds of its
// motion by rounding alone is taken to be at rest there.  Nothing is returned where it cannot be.
std::optional<KerrMotion> kerr_motion(const KerrHole& hole, double r, double theta, double energy,
                                      double momentum, double carter_q, int sign_r, int sign_theta);
// Returns that of a circle of angular velocity dphi/dt, or nothing where it would be faster than light.
std::optional<KerrMotion> kerr_circling(const KerrHole& hole, double r, double theta,
                                        double angular_velocity);
// Returns the angular velocity of who has no angular momentum (ZAMO), or has that speed against it, with
// the spin.  On the axis there is none.
double dragged_velocity(const KerrHole& hole, double r, double theta, double speed = 0);
// Returns the motion of who has that angular momentum and neither rises nor turns to a pole at r and
// theta, outside the horizon and, if it is not 0, off the axis.
KerrMotion kerr_dragged(const KerrHole& hole, double r, double theta, double momentum = 0);
// Returns the motion at the smallest r of a bound orbit, where it crosses the equator northwards.
// `inclination` is 0 to pi: its orbit reaches so far from the equator, and goes against the spin beyond
// pi/2.  Nothing is returned where no such orbit is, or where it would fall in.
std::optional<KerrMotion> kerr_bound(const KerrHole& hole, double periastron, double apoastron,
                                     double inclination);

// Returns A = k.n of what moves with r' = `speed` and P, Mino's time as the unit; it is finite where light
// falls in.
double along_falling(const KerrHole& hole, double r, double p, double speed, double carter);

// Returns u^t of a circle of that angular velocity.
double circling_rate(const KerrHole& hole, double r, double theta, double angular_velocity);

}  // namespace domefall
