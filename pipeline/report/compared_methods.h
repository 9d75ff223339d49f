// The report compares several methods of following a ray, each at several settings.  A new method
// needs to be added to the list of compared_methods() only.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/optics/traced_ray.h"

namespace domefall {

struct FollowedRay {
  std::optional<SkyRegion> origin;  // none if the method does not decide
  double phi;                       // swept azimuth, radians
};

// A RayMethod is one way to follow a ray, with the settings at which the report tries it.
struct RayMethod {
  std::string name;              // as in `domefall trace --method`
  std::string setting_name;      // bits of a table, tolerance of a step, or empty
  std::vector<double> settings;  // at least one
  double default_setting;        // one of them
  bool keeps_tables;             // whether the first ray at a radius builds tables for all others
  std::function<FollowedRay(const RayRequest&, double setting)> follow;
};

// Returns the methods.  If quick, none of them has more than two settings.
std::vector<RayMethod> compared_methods(bool quick);

}  // namespace domefall
