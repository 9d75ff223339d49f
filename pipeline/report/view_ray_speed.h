// measure_view_ray_speed() says what a view ray costs in a frame.  There 128 view rays are traced
// together from the camera to the sky, with aberration, table, redshift and footprint.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct ViewRaySpeedRow {
  std::string from;  // the observer
  double ns;         // wall clock for one view ray on one thread, by the best of several passes
};

// Measures view rays with every sky lit.  This takes about 0.2 s.
std::vector<ViewRaySpeedRow> measure_view_ray_speed();

}  // namespace domefall
