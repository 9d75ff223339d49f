// reference_disc() is the truth that pictures of discs are measured against.  It finds where the
// light of one direction of view left the disc, by following the ray step by step.  It shares no
// code with the renderer, which knows places along rays in closed form.
//
// Near a hole of charge q, which may be 0 (M = 1), the place x of light, |x| = r, as a vector of
// Euclidean space, obeys
//     d^2 x/d lambda^2 = (-3/r^5 + 2 q^2/r^6) h^2 x,   h = |x cross dx/dlambda|,
// with an affine lambda, in every region: its radial part is r'' = L^2/r^3 - 3 L^2/r^4 + 2 q^2
// L^2/r^5, as the derivative of r'^2 = E^2 - f L^2/r^2 says, f = 1 - 2/r + q^2/r^2, and its plane is
// fixed.  Time along the ray is counted by the null coordinate v = t + r*.
#pragma once

#include <array>
#include <vector>

namespace domefall {

using Vector3 = std::array<double, 3>;

// A ReferenceDiscView is an observer and a disc.  The observer moves with the celerity gamma v
// against a frame of radial free fall.  This frame falls in from rest at infinity or, if
// `outgoing`, rises to rest there.  Near a charge it is the tetrad T of spacetime/charged.h.  Components are along R (away from the hole outside), Theta and
// Phi.
struct ReferenceDiscView {
  double r = 10;  // M, > 0
  bool outgoing = false;
  Vector3 celerity{0, 0, 0};
  Vector3 normal{0, -1, 0};  // the disc turns counter-clockwise about it
  double inner = 6, outer = 20;
  bool plunging = false;  // whether gas falls in below the last stable orbit
  double charge = 0;
};

struct ReferenceDiscPlace {
  int order;          // how often the ray met the disc's plane before, at whatever radius
  double r;           // M
  double azimuth;     // in the plane, from R's part in it (from Theta's if it has none), radians
  double one_plus_z;  // frequency sent over the one that the observer measures
  double steepness;   // the cosine, for the gas, of the angle between ray and normal, 0 to 1
  // This is the temperature of the gas over that of the hottest ring outside the last stable orbit.  The observer sees
  // a blackbody of temperature/one_plus_z, whose bolometric radiance is the fourth power of that.
  double temperature;
  // The observer's v, or its u = t - r* if outgoing, minus the gas's v = t + r*, M.
  double delay;
};

// Returns the places of the disc, in region I, on the ray that comes in from `direction`, the
// nearest first, of orders below `orders`.  `direction` is a unit vector in the observer's own
// frame, whose axes are the boosted R, Theta and Phi.  Measured against the closed form of places
// along rays: r and one_plus_z agree within a relative 1e-9 exp(pi order).  Light that set out
// outwards from within 1e-6 of the horizon is left out.
std::vector<ReferenceDiscPlace> reference_disc(const ReferenceDiscView& view,
                                               const Vector3& direction, int orders = 4);

// A ReferenceGasStep is a small step back along a ray that one follows in the same way: the place and
// the rate of change at its middle, and its length in lambda.  The observer measures the frequency 1.
struct ReferenceGasStep {
  Vector3 place, rate;
  double energy, length;
};
// Follows the ray to r = `outer`, or to the horizon, in steps of at most this part of r.
std::vector<ReferenceGasStep> reference_steps(const ReferenceDiscView& view,
                                              const Vector3& direction, double outer, double part);

}  // namespace domefall
