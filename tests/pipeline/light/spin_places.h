// Places of observers near holes that spin.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/light/kerr_start.h"
#include "trajectories/observer_state.h"

namespace domefall {

struct SpinPlace {
  double spin, charge, r, theta;
  bool third = false;

  KerrPlace at() const { return {{spin, charge}, r, theta}; }
  KerrEdge edge() const { return third ? KerrEdge::kRegionThree : KerrEdge::kSilhouette; }

  // An observer there, about an axis that points to z.
  ObserverState observer() const {
    ObserverState o;
    o.spacetime = SpinningHole{1, {spin, charge}};
    o.r = r;
    o.region = r > o.spacetime.horizon() ? Region::kI : Region::kII;
    const double s = std::sin(theta), c = std::cos(theta);
    o.sky_from_tetrad = from_columns({s, 0, c}, {c, 0, -s}, {0, 1, 0});
    return o;
  }
};

inline std::vector<SpinPlace> spin_places() {
  return {{0.9, 0, 10, 1.2},      {0.9, 0, 1.6, 1.2},
          {0.5, 0, 6, 1e-3},      {0.9, 0, 6, 0},
          {0.5, 0.7, 20, 2},      {0.9, 0, 1, 1.2},
          {0.9, 0, 1, 1.2, true}, {0.998, 0, 6, std::numbers::pi / 2}};
}

}  // namespace domefall
