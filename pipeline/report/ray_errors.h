// measure_rays() gives error against run time of every method of following a ray, by the observer's
// region and the kind of difficulty.  The truth is reference_ray().
#pragma once

#include <string>
#include <vector>

#include "pipeline/report/compared_methods.h"
#include "pipeline/report/ray_samples.h"

namespace domefall {

struct RayErrorRow {
  std::string region, difficulty, method;
  double setting;
  bool is_default;  // whether it is the default setting of its method
  int rays;
  int undecided;  // with no finite azimuth or a wrong origin; these are not in the errors below
  // The error of phi is relative to max(1, phi).  One value is the worst, and 99 of 100 rays are
  // right to within the other.
  double phi_worst, phi_99;
  // These are the same error as a displacement on the observer's sky, which is |error of phi| over
  // |d phi/d delta|, in radians.
  double sky_worst, sky_99;
  double ns_per_ray;  // azimuth and slope, where tables have been built
  double build_us;    // the median for all tables of one radius; 0 without tables
};

// Measures one method at one setting over groups of rays.  Each group is timed as a whole by the
// wall clock.  The best of `repeats` passes counts, because the others include the time of other
// programs.
RayErrorRow measure_class(const RayClass& of, const std::vector<RayGroup>& groups,
                          const RayMethod& method, double setting, int repeats);

// Measures every class by every method and setting.  If quick, there are few rays and settings, and
// this takes seconds.
std::vector<RayErrorRow> measure_rays(bool quick);

}  // namespace domefall
