// Random rays from the past singularity, for the tests of what is known of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "pipeline/light/null_ray.h"

namespace domefall {

struct Case {
  Radius at;
  bool outgoing;
};

inline std::string name(const Case& c) {
  return "r - 2 = " + std::to_string(c.at.above_horizon) + (c.outgoing ? " outgoing" : " rain");
}

// Rays nearer to the axis than this (sines of half the angle) are left out; at r = 2 itself, where
// E = 0 lies on it, those nearer than the second.
struct NearAxis {
  double nearest = 0, nearest_at_horizon = 1e-8;
};

// Any angle in the frame of the table; logarithmically near the axis and the edges, down to
// `closest`.
class Rays {
 public:
  Rays(const Case& c, std::uint64_t seed, NearAxis axis = {}, double closest = 1e-12)
      : c_(c), random_(seed), axis_(axis), digits_(-std::log10(closest)) {}

  NullRay next() {
    for (;;) {
      const NullRay ray = any();
      if (std::min(ray.sin_half, ray.cos_half) <= axis_.nearest || circles_for_ever(ray)) continue;
      if (c_.at.above_horizon == 0 && ray.sin_half < axis_.nearest_at_horizon) continue;
      if (origin_of(ray) == SkyRegion::kIV) return ray;
    }
  }

 private:
  NullRay any() {
    using std::numbers::pi;
    const RadialFrame frame{c_.outgoing, false};
    const double small = std::pow(10, -digits_ * uniform_(random_));
    const double side = uniform_(random_) < 0.5 ? -1 : 1, which = uniform_(random_);
    if (which < 0.3) return ray_off_edge(c_.at, Critical::kFirst, side * small, frame);
    if (which < 0.6) return ray_off_edge(c_.at, Critical::kSecond, side * small, frame);
    if (which < 0.8) return ray_at(c_.at, pi * uniform_(random_), frame);
    return ray_at(c_.at, side > 0 ? small : pi - small, frame);
  }

  Case c_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  NearAxis axis_;
  double digits_;
};

}  // namespace domefall
