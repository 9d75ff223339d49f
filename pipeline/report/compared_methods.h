// The methods to follow a ray that the report compares, and the settings of each.  A new method is
// added to this list only.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/optics/traced_ray.h"

namespace domefall {

struct FollowedRay {
  std::optional<SkyRegion> origin;  // none if the method does not decide
  double phi;
};

struct RayMethod {
  std::string name;              // as in `domefall trace --method`
  std::string setting_name;      // bits of a table, tolerance of a step, or empty
  std::vector<double> settings;  // at least one
  double default_setting;        // one of them
  bool keeps_tables;             // the first ray at a radius pays for those that follow
  std::function<FollowedRay(const RayRequest&, double setting)> follow;
};

// If quick, each method has few settings.
std::vector<RayMethod> compared_methods(bool quick);

}  // namespace domefall
