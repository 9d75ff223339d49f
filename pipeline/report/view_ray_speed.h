// What a look costs in a frame: 128 directions at a time from camera to sky, aberration, table,
// redshift and footprint included, as against a ray by itself.
#pragma once

#include <string>
#include <vector>

namespace domefall {

struct ViewRaySpeedRow {
  std::string from;  // the observer
  double ns;         // wall clock for one direction, one thread, the best of several passes
};

// Every sky lit.  About 0.2 s.
std::vector<ViewRaySpeedRow> measure_view_ray_speed();

}  // namespace domefall
