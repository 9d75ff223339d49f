// These functions follow light near a charge and in a wormhole step by step, from the equations of motion
// alone.  They share nothing with pipeline/light, and show what its integrals and tables save.
//
//     a charge     w'' = -w + 3 w^2 - 2 q^2 w^3 along the azimuth, with w = 1/r
//     a wormhole   l'' = b^2 r'/r^3 and phi' = b/r^2 along the ray, with b = r sin(delta)
#pragma once

#include <optional>

#include "pipeline/light/traced_charge.h"
#include "pipeline/light/traced_wormhole.h"
#include "pipeline/report/integrated_fall.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

struct FollowedRay {
  std::optional<SkyRegion> origin;  // none if it is not decided
  double phi;                       // swept azimuth, radians
};

// Followed back in time a ray ends at w = 0, or far from the throat, where the rest of the azimuth is that
// of a straight line.  The sky is I for the observer's own exterior or side, and III for the other one.
// `tolerance` is that of a step, relative.
FollowedRay step_charged_ray(const ChargedRequest& request, FallMethod method, double tolerance);
FollowedRay step_wormhole_ray(const WormholeRequest& request, FallMethod method, double tolerance);

}  // namespace domefall
