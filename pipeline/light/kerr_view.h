// Directions of view by delta and eta (kerr_start.h), as unit vectors along R, Theta and Phi.
#pragma once

#include <cmath>

#include "pipeline/light/kerr_start.h"
#include "trajectories/directions.h"

namespace domefall {

inline V3d kerr_view(double delta, double eta) {
  const double s = std::sin(delta);
  return {-std::cos(delta), -s * std::cos(eta), -s * std::sin(eta)};
}
inline KerrDirection kerr_direction_of(const V3d& view) {
  const double beside = std::hypot(view.y, view.z);
  return {std::atan2(beside, -view.x), beside > 0 ? std::atan2(-view.z, -view.y) : 0};
}

// The unit vectors of view in which delta grows, and across that eta.  The view is minus the photon's.
struct ViewAxes {
  V3d by_delta, across;

  ViewAxes(double delta, double eta) {
    const double c = std::cos(delta), s = std::sin(delta), ce = std::cos(eta), se = std::sin(eta);
    by_delta = {s, -c * ce, -c * se};
    across = {0, se, -ce};
  }
};

}  // namespace domefall
