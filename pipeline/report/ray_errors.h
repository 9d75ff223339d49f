// measure_rays() gives error against run time of every method of following a ray, by the observer's
// region and the kind of difficulty.  A new method needs to be added to
// the list of compared_methods() only.  measure_view_ray_speed() says what a view ray costs in a
// frame, where 128 of them are traced together from the camera to the sky, with aberration, table,
// redshift and footprint.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/report/ray_samples.h"
#include "pipeline/report/stepped_light.h"

namespace domefall {

// A RayMethod is one way to follow a ray, with the settings at which the report tries it.
struct RayMethod {
  std::string name;              // as in `domefall trace --method`
  std::string setting_name;      // bits of a table, tolerance of a step, or empty
  std::vector<double> settings;  // at least one
  double default_setting;        // one of them
  bool keeps_tables;             // whether the first ray at a radius builds tables for all others
  std::function<FollowedRay(const AnyRay&, double setting)> follow;
};

// Returns the methods for rays of a kind.  If quick, none of them has more than two settings.
std::vector<RayMethod> compared_methods(RayKind kind, bool quick);

struct ViewRaySpeedRow {
  std::string from;  // the observer
  double ns;         // wall clock for one view ray on one thread, by the best of several passes
};

// Measures view rays with every sky lit.  This takes about 0.2 s.
std::vector<ViewRaySpeedRow> measure_view_ray_speed();

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
