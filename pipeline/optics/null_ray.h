// A light ray as it reaches an observer, and what decides where it came from: its angle alpha in
// the frame of radial free fall at the observer's place, and its distances from the edges there.
//
// Rain (falling in):  alpha = delta, the angle from -R, the direction of the hole,
//     k = T + cos(delta) R + sin(delta) Theta,   E = 1 - s cos(delta),   L = r sin(delta),
// s = sqrt(2/r), M = 1.  [Riazuelo] eq. def_k_prec, and app. app_geod for the origins.
// Outgoing frame (T_I' of [Riazuelo]):  alpha = pi - delta, the angle from +R.  Time reversal makes
// the two one: E and L are the same functions of r and alpha, k^r has the opposite sign.
//
// Near an edge the sweep depends on the distance to that edge, not on the angle, so a ray carries
// that distance and never recovers it by subtraction.
#pragma once

#include "pipeline/optics/radius.h"
#include "trajectories/sky_region.h"

namespace domefall {

// The two rays with |L/E| = 3 sqrt 3, where the sweep diverges or an edge may be, by their alpha.
//   rain, r > 3:      kFirst is the silhouette's edge, kSecond the incoming ray farther out
//   rain, 2 < r < 3:  kFirst is the silhouette's edge, kSecond an outgoing ray within it
//   rain, r <= 2:     kFirst is the silhouette's edge, kSecond that of region III
//   outgoing, r > 2:  kSecond is the silhouette's edge: sky I lies at smaller alpha
enum class Critical { kFirst, kSecond };

struct NullRay {
  Radius at;                  // r > 0
  double sin_half, cos_half;  // of alpha/2, alpha in [0, pi]
  // sin(alpha/2) - T cos(alpha/2), T the tangent of half the edge: positive beyond the edge.  Full
  // relative accuracy.
  double gap_first, gap_second;
  bool outgoing = false;
};

// Frames that move radially against each other: rain or the outgoing frame itself, or the frame at
// rest in r (outside) or in t (inside: T_II and, with `outgoing`, T_IV of [Riazuelo] eq. TR_IV;
// r != 2), which sees alpha at tan(alpha_rest/2) = tan(alpha/2)/kappa.
struct RadialFrame {
  bool outgoing = false;
  bool at_rest = false;
};
// sqrt(|1 - s|/(1 + s)) if at rest, else 1.
double kappa(const Radius& at, const RadialFrame& frame);

// An angle in [0, pi] and what is left to pi, each to full relative accuracy.
struct PolarAngle {
  long double angle, rest;

  PolarAngle reversed() const { return {rest, angle}; }
};
PolarAngle polar_angle(long double angle);

// alpha in [0, pi], in that frame.
NullRay ray_at(const Radius& at, const PolarAngle& alpha, const RadialFrame& frame = {});
NullRay ray_at(const Radius& at, long double alpha, const RadialFrame& frame = {});
// alpha = edge + offset in that frame, the offset given to full relative accuracy.
NullRay ray_off_edge(const Radius& at, Critical edge, double offset, const RadialFrame& frame = {});
// tan(alpha/2) given: for rays that are not near an edge.  Infinite for alpha = pi.
NullRay ray_of_tangent(const Radius& at, double tangent, bool outgoing);
// tan(alpha/2) = T (1 + excess), T that of the critical ray; excess > -1, and |excess| given to
// full relative accuracy.
NullRay ray_of_ratio(const Radius& at, Critical edge, double excess, bool outgoing);
// The ray turned by a small angle in alpha; sin_half < 0 if that passes the axis.
NullRay turned(const NullRay& ray, double angle);

double alpha_of(const NullRay& ray);
// tan(alpha/2) of an edge.
double tan_half_critical(const Radius& at, Critical edge);

// A ray exactly on an edge never arrives: it is counted to the past singularity.
SkyRegion origin_of(const NullRay& ray);

// Exactly critical, and on its way past the light circle: it never arrived from anywhere.
bool circles_for_ever(const NullRay& ray);

// |E|, E - L/(3 sqrt 3) and E + L/(3 sqrt 3), each as a product without cancellation; L; k^r.
struct RayInvariants {
  double energy;  // signed
  double angular_momentum;
  double radial;                          // k^r
  double below_critical, above_critical;  // E - L/sqrt 27, E + L/sqrt 27
};
RayInvariants invariants(const NullRay& ray);

// 1 + z = |E| for the free-fall observer itself; emitted over observed frequency.
double one_plus_z(const NullRay& ray);

}  // namespace domefall
