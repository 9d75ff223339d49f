// Error against run time of every way to follow a ray, by the observer's region and the kind of
// difficulty; the truth is reference_ray.
#pragma once

#include <string>
#include <vector>

#include "pipeline/report/compared_methods.h"
#include "pipeline/report/ray_samples.h"

namespace domefall {

struct RayErrorRow {
  std::string region, difficulty, method;
  double setting;
  bool is_default;  // of its method
  int rays;
  int undecided;  // no finite azimuth, or another origin than the true one; not in the errors below
  // Of phi, relative to max(1, phi): the worst, and what 99 of 100 rays stay below.
  double phi_worst, phi_99;
  // The same error as a displacement on the observer's sky, |error of phi|/|d phi/d delta|,
  // radians.
  double sky_worst, sky_99;
  double ns_per_ray;  // azimuth and slope, tables at hand
  double build_us;    // all tables of one radius, the median; 0 without
};

// One method at one setting over groups of rays.  Timed by the wall clock in batches of a group,
// the best of `repeats` passes; the best is what the code costs, the rest what else the machine
// does.
RayErrorRow measure_class(const RayClass& of, const std::vector<RayGroup>& groups,
                          const RayMethod& method, double setting, int repeats);

// Every class, method and setting; quick: few rays and settings, in seconds.
std::vector<RayErrorRow> measure_rays(bool quick);

}  // namespace domefall
