// Directions of view by delta and eta (kerr_start.h), as unit vectors along R, Theta and Phi.
#pragma once

#include <array>
#include <cmath>
#include <optional>

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

inline double kerr_edge_delta(const KerrPlace& at, double eta,
                              KerrEdge edge = KerrEdge::kSilhouette) {
  return static_cast<double>(critical_ray(at, eta, edge).delta);
}

// A KerrEnergy gives E of light that is one in the tetrad's frame: what is sent, over what is seen.
class KerrEnergy {
 public:
  explicit KerrEnergy(const KerrPlace& at)
      : sigma_(static_cast<double>(at.r * at.r + at.sigma())),
        delta_(static_cast<double>(at.delta())),
        side_(static_cast<double>(at.hole.spin * std::sin(at.theta)) * std::sqrt(sigma_)) {}

  double operator()(double delta, double eta) const {
    const double s = std::sin(delta / 2), c = std::cos(delta / 2);
    return (sigma_ * s * s + delta_ * c * c + 2 * side_ * std::sin(eta) * s * c) / sigma_;
  }
  double sigma() const { return sigma_; }  // r^2 + a^2 cos^2(theta)

 private:
  double sigma_, delta_, side_;
};

// E, sqrt K and L of light that is one in the tetrad's frame.
struct KerrConstants {
  double energy, momentum, about_axis;

  KerrConstants(const KerrPlace& at, double delta, double eta) {
    const KerrEnergy energy_of(at);
    energy = energy_of(delta, eta);
    momentum = std::sqrt(energy_of.sigma()) * std::sin(delta);
    const double sine = std::sin(static_cast<double>(at.theta));
    about_axis =
        sine * (momentum * std::sin(eta) + static_cast<double>(at.hole.spin) * energy * sine);
  }
  // Light that an observer in the hole gets from its other side does not come from region I.  That of
  // E < 0 may come from its ergosphere.
  bool comes_from_region_one(const KerrPlace& at) const {
    const auto horizon = static_cast<double>(at.hole.horizon()),
               a = static_cast<double>(at.hole.spin);
    return static_cast<double>(at.r) >= horizon ||
           energy * (horizon * horizon + a * a) > a * about_axis;
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

// Returns x and y of v = x a + y b, all in one plane, or nothing where a and b are parallel.
inline std::optional<std::array<double, 2>> parts_along(const V3d& v, const V3d& a, const V3d& b) {
  const V3d normal = a.cross(b);
  const double square = normal.length2();
  if (!(square > 0)) return std::nullopt;
  return std::array{v.cross(b).dot(normal) / square, a.cross(v).dot(normal) / square};
}

}  // namespace domefall
