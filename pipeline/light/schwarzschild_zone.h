// The parts of the view in which the skies are seen near a Schwarzschild hole.
#pragma once

#include "pipeline/light/null_ray.h"
#include "pipeline/light/sky_table.h"

namespace domefall {

// Returns one of three zones of the frame of free fall:
//   rain, Critical::kFirst      the home sky, from the silhouette to alpha = pi; any finite r > 0
//   rain, Critical::kSecond     the far sky, from its edge to alpha = 0; 0 < r < 2
//   outgoing, Critical::kSecond the home sky, from the silhouette to alpha = 0; r > 2
SkyZone schwarzschild_zone(const Radius& at, Critical edge, bool outgoing = false);

// Returns the x of a ray in the table of such a zone, from the ray's exact gap.
double distance_of(const SkyZone& zone, const NullRay& ray);

}  // namespace domefall
