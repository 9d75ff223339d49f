// What a view ray costs in a frame, where 128 are traced together from the camera to the sky, with
// aberration, table, redshift and footprint.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct ViewRaySpeedRow {
  std::string from;  // the observer
  double ns;         // wall clock for one view ray on one thread, by the best of several passes
};

// Every sky is lit.  This takes about 0.2 s.
std::vector<ViewRaySpeedRow> measure_view_ray_speed();

}  // namespace domefall
