// A KerrClock gives r# and r* of a hole that spins (kerr.h) in doubles, for gas that pixels see.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/spacetime/kerr.h"

namespace domefall {

class KerrClock {
 public:
  explicit KerrClock(const KerrHole& hole)
      : spin_(static_cast<double>(hole.spin)),
        apart_(static_cast<double>(2 * hole.horizon_distance())),
        inner_(static_cast<double>(hole.inner_horizon())),
        square_(static_cast<double>(hole.horizon() * hole.horizon() + hole.spin * hole.spin)) {}

  // On the horizons, where both are infinite and no pattern shows, they are finite numbers.
  double twist(double r) const { return spin_ * of_ratio(r); }
  double tortoise(double r) const {
    const double above = std::max(std::abs(r - inner_), 1e-300);
    return r + 2 * logarithm(above) + square_ * of_ratio(r);
  }

 private:
  // ln|(r - r_+)/(r - r_-)|/(r_+ - r_-)
  double of_ratio(double r) const {
    const double x = apart_ / (r - inner_);
    const double log =
        std::abs(x) < 0.1 ? std::log1p(-x) : logarithm(std::max(std::abs(1 - x), 1e-300));
    return log / apart_;
  }

  double spin_, apart_, inner_, square_;
};

}  // namespace domefall
