// A light ray as it reaches an observer, by its angle delta from -R (the direction of the hole) in
// the rain frame, and what that decides: where the ray came from, and its two invariants.
//     k = T + cos(delta) R + sin(delta) Theta,   E = 1 - s cos(delta),   L = r sin(delta),
// s = sqrt(2/r), M = 1.  [Riazuelo] eq. def_k_prec; app_geod for the origins.
//
// Near an edge the sweep depends on the distance to that edge, not on delta, so a ray carries that
// distance and never recovers it by subtraction.
#pragma once

#include "pipeline/optics/radius.h"

namespace domefall {

enum class Edge { kSilhouette, kRegionThree };

enum class Origin {
  kSkyOne,
  kSkyThree,
  kPastSingularity,
};

struct NullRay {
  Radius at;                  // r > 0
  double sin_half, cos_half;  // of delta/2, delta in [0, pi]
  // sin(delta/2) - T cos(delta/2), T = tan(half the edge): positive beyond the edge.  Full relative
  // accuracy.  `gap_three` has a meaning only for r <= 2.
  double gap_silhouette, gap_three;
};

// delta in [0, pi].
NullRay ray_at(const Radius& at, double delta);
// delta = edge + offset, the offset given to full relative accuracy.  Edge::kRegionThree: r <= 2.
NullRay ray_off_edge(const Radius& at, Edge edge, double offset);

double delta_of(const NullRay& ray);

// A ray exactly on an edge never arrives: it is counted to the past singularity.
Origin origin_of(const NullRay& ray);

// |E|, E - L/(3 sqrt 3) and E + L/(3 sqrt 3), each as a product without cancellation; L; k^r.
struct RayInvariants {
  double energy;  // signed
  double angular_momentum;
  double radial;                          // k^r
  double below_critical, above_critical;  // E - L/sqrt 27, E + L/sqrt 27
};
RayInvariants invariants(const NullRay& ray);

// 1 + z = |E| for the rain observer itself; emitted over observed frequency.
double one_plus_z(const NullRay& ray);

}  // namespace domefall
