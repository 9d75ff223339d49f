// A NullRay is a light ray as it reaches an observer, with what decides where it came from.  That
// is its angle alpha in the frame of radial free fall at the observer's place, and its distances
// from the edges there.
//
// In rain (falling in) alpha = delta, the angle from -R, the direction of the hole.  With
// s = sqrt(2/r) and M = 1,
//     k = T + cos(delta) R + sin(delta) Theta,   E = 1 - s cos(delta),   L = r sin(delta).
// [Riazuelo] eq. def_k_prec, and app. app_geod for the origins.  In the outgoing frame (T_I' of
// [Riazuelo]) alpha = pi - delta, the angle from +R.  Time reversal makes the two one: E and L are
// the same functions of r and alpha, and k^r has the opposite sign.
//
// Near an edge the sweep depends on the distance to that edge, not on the angle.  So a ray carries
// that distance and never recovers it by subtraction.
#pragma once

#include "pipeline/spacetime/radius.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

// A Critical is one of the two rays with |L/E| = 3 sqrt 3, where the sweep diverges or an edge may
// be, by its alpha.
//   rain, r > 3:      kFirst is the silhouette's edge, kSecond the incoming ray farther out
//   rain, 2 < r < 3:  kFirst is the silhouette's edge, kSecond an outgoing ray within it
//   rain, r <= 2:     kFirst is the silhouette's edge, kSecond that of region III
//   outgoing, r > 2:  kSecond is the silhouette's edge, with sky I at smaller alpha
enum class Critical { kFirst, kSecond };

struct NullRay {
  Radius at;                  // r > 0
  double sin_half, cos_half;  // of alpha/2, alpha in [0, pi]
  // The gaps are sin(alpha/2) - T cos(alpha/2), with T the tangent of half the edge, and are
  // positive beyond the edge.  They have full relative accuracy.
  double gap_first, gap_second;
  bool outgoing = false;
};

// A RadialFrame is one of the frames that move radially against each other.  It is rain or the
// outgoing frame itself, or the frame at rest in r (outside) or in t (inside).  The last is T_II
// and, with `outgoing`, T_IV of [Riazuelo] eq. TR_IV, for r != 2.  A frame at rest sees alpha at
// tan(alpha_rest/2) = tan(alpha/2)/kappa.
struct RadialFrame {
  bool outgoing = false;
  bool at_rest = false;
};
// Returns sqrt(|1 - s|/(1 + s)) if the frame is at rest, else 1.
double kappa(const Radius& at, const RadialFrame& frame);

// A PolarAngle is an angle in [0, pi] with what is left to pi, each to full relative accuracy.
struct PolarAngle {
  long double angle, rest;

  PolarAngle reversed() const { return {rest, angle}; }
};
PolarAngle polar_angle(long double angle);

// Returns the ray at alpha in [0, pi], an angle in that frame.
NullRay ray_at(const Radius& at, const PolarAngle& alpha, const RadialFrame& frame = {});
NullRay ray_at(const Radius& at, long double alpha, const RadialFrame& frame = {});
// Returns the ray at alpha = edge + offset in that frame.  The offset has full relative accuracy.
NullRay ray_off_edge(const Radius& at, Critical edge, double offset, const RadialFrame& frame = {});
// Returns the ray of tan(alpha/2), which is infinite for alpha = pi.  It serves rays that are not
// near an edge.
NullRay ray_of_tangent(const Radius& at, double tangent, bool outgoing);
// Returns the ray of tan(alpha/2) = T (1 + excess), with T that of the critical ray.  excess > -1,
// and |excess| has full relative accuracy.
NullRay ray_of_ratio(const Radius& at, Critical edge, double excess, bool outgoing);
// Returns the ray turned by a small angle in alpha.  sin_half < 0 if that passes the axis.
NullRay turned(const NullRay& ray, double angle);

double alpha_of(const NullRay& ray);
// Returns tan(alpha/2) of an edge.
double tan_half_critical(const Radius& at, Critical edge);

// Returns the origin of a ray.  One exactly on an edge never arrives, and is counted to the past
// singularity.
SkyRegion origin_of(const NullRay& ray);

// Says whether a ray is exactly critical, and on its way past the light circle.  Then it never
// arrived from anywhere.
bool circles_for_ever(const NullRay& ray);

// RayInvariants are E, L, k^r, E - L/(3 sqrt 3) and E + L/(3 sqrt 3).  Each is found as a product,
// without cancellation.
struct RayInvariants {
  double energy;  // signed
  double angular_momentum;
  double radial;                          // k^r
  double below_critical, above_critical;  // E - L/sqrt 27, E + L/sqrt 27
};
RayInvariants invariants(const NullRay& ray);

// Returns 1 + z = |E| for the free-fall observer itself.  It is the emitted over the observed
// frequency.
double one_plus_z(const NullRay& ray);

}  // namespace domefall
