// These functions follow light near a charge, in a wormhole and about a spin step by step, from the
// equations of motion alone.  They share nothing with pipeline/light, and show what its integrals and
// tables save.
//
//     a charge     w'' = -w + 3 w^2 - 2 q^2 w^3 along the azimuth, with w = 1/r
//     a wormhole   l'' = b^2 r'/r^3 and phi' = b/r^2 along the ray, with b = r sin(delta)
//     a spin       the equations of reference_spin.h over Mino's time; or those of kerr_schild.h
#pragma once

#include <optional>

#include "pipeline/light/kerr_start.h"
#include "pipeline/light/traced_charge.h"
#include "pipeline/light/traced_wormhole.h"
#include "pipeline/report/integrated_fall.h"
#include "pipeline/spacetime/regions.h"
#include "trajectories/directions.h"

namespace domefall {

struct FollowedRay {
  std::optional<SkyRegion> origin;  // none if it is not decided
  double phi;                       // swept azimuth, radians
  V3d place{0, 0, 0};               // about a spin instead of phi: where on the sky, a unit vector
};

// A ray about a spin, whose delta is given together with an edge and an offset, too.
struct SpinRequest {
  KerrPlace at;
  KerrDirection direction;
};

// Followed back in time a ray ends at w = 0, or far from the throat, where the rest of the azimuth is that
// of a straight line.  The sky is I for the observer's own exterior or side, and III for the other one.
// `tolerance` is that of a step, relative.
FollowedRay step_charged_ray(const ChargedRequest& request, FallMethod method, double tolerance);
FollowedRay step_wormhole_ray(const WormholeRequest& request, FallMethod method, double tolerance);
// Light of E < 0, from sky III, is followed as its mirror image.  One step more than `tolerance` asks for
// is taken to w = 0, or to a distance of 1e8, where light goes straight.
FollowedRay step_ray_over_mino_time(const SpinRequest& request, FallMethod method,
                                    double tolerance);
FollowedRay step_kerr_schild_ray(const SpinRequest& request, FallMethod method, double tolerance);

}  // namespace domefall
