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

inline double kerr_edge_delta(const KerrPlace& at, double eta) {
  return static_cast<double>(critical_ray(at, eta, KerrEdge::kSilhouette).delta);
}

// E, sqrt K and L of light that is one in the tetrad's frame.
struct KerrConstants {
  double energy, momentum, about_axis;

  KerrConstants(const KerrPlace& at, double delta, double eta) {
    const auto r = static_cast<double>(at.r), a = static_cast<double>(at.hole.spin);
    const double sine = std::sin(static_cast<double>(at.theta)),
                 sigma = r * r + static_cast<double>(at.sigma());
    const double s = std::sin(delta / 2), c = std::cos(delta / 2);
    momentum = std::sqrt(sigma) * 2 * s * c;
    const double y = momentum * sine * std::sin(eta);
    energy = (sigma * s * s + static_cast<double>(at.delta()) * c * c + a * y) / sigma;
    about_axis = y + a * energy * sine * sine;
  }
  // Light that an observer in the hole gets from its other side does not come from region I.
  bool comes_from_region_one(const KerrPlace& at) const {
    const auto horizon = static_cast<double>(at.hole.horizon()),
               a = static_cast<double>(at.hole.spin);
    return energy > 0 && (static_cast<double>(at.r) >= horizon ||
                          energy * (horizon * horizon + a * a) > a * about_axis);
  }
};

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
