// This file says how far from a pixel the middle of what it shows may lie.
#pragma once

#include "pipeline/render/scene/point_spread.h"

namespace domefall {

// Returns how far the smallest blob reaches, in radians.
inline double pixel_reach(const Show& show, const Projection& projection) {
  constexpr double kSigmas = 3.5;
  return kSigmas * PointSpread(show.point_spread, projection, 1).least();
}

}  // namespace domefall
