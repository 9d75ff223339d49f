// A body that shines on an orbit of its own about the hole, in region I.
#pragma once

#include <string>

#include "trajectories/directions.h"

namespace domefall {

struct Body {
  std::string name;
  double r = 10;  // of its circular orbit, M; > 3
  // The axis about which it goes counter-clockwise, and the direction in its plane from which its
  // azimuth counts, both on the sky.
  SkyDirection normal{V3d(0, 0, 1)}, node{V3d(1, 0, 0)};
  // Where it is when its v = t + r* is that of the show's start, radians.
  double azimuth = 0;
  double temperature = 6000;  // of a blackbody, K
  // V, as it would be at rest at a distance of kBodyMagnitudeDistance without a hole.
  double magnitude = 0;
};
inline constexpr double kBodyMagnitudeDistance = 100;  // M

}  // namespace domefall
