// The ways to follow a ray that the report compares, and the settings of each: the one list that a
// new method is added to.
#pragma once

#include <string>
#include <vector>

#include "pipeline/optics/traced_ray.h"

namespace domefall {

struct RayMethod {
  std::string name;
  TraceMethod method;
  std::string setting_name;      // bits of a table, tolerance; empty where there is none
  std::vector<double> settings;  // at least one
  double default_setting;        // one of them
  bool keeps_tables;             // the first ray at a radius pays for those that follow
};

// quick: few settings of each.
std::vector<RayMethod> ray_methods(bool quick);

TracedRay trace_by(const RayMethod& method, double setting, const RayRequest& request);

}  // namespace domefall
