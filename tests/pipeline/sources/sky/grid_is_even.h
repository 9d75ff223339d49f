// Asks about one place at a time.
#pragma once

#include "pipeline/sources/sky/formula_sky.h"

namespace domefall {

// Whether no border is within `reach` radians of a direction.
inline bool grid_is_even(const SkyDirection& direction, double reach) {
  const V3d& d = direction.v;
  const double footprint = 0;
  GridLight light{};
  float even = 0;
  grid_lights({&d.x, &d.y, &d.z, &footprint, &reach}, 1, {&light.squares, &light.discs, &even});
  return even != 0;
}

}  // namespace domefall
