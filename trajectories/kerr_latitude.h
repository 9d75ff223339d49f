// The place of a geodesic about a hole that spins, less the turn about its axis, as a unit vector N over
// Mino time l (kerr_orbit.h):
//
//     N'' = -(C + 2 k N_z^2) N + k N_z z
//
// which has no axis.  N_z repeats itself, and N then has turned about z.
#pragma once

#include <array>
#include <vector>

#include "trajectories/directions.h"
#include "trajectories/taylor_series.h"

namespace domefall {

class KerrLatitude {
 public:
  // It has that N and N' at l = 0, which tell C.
  KerrLatitude(double k, const V3d& n, const V3d& speed);

  struct Node {
    double l;
    V3d n, speed;
    double squares = 0, turned = 0;  // the integral of N_z^2, and the azimuth of N since l = 0
  };
  Node at(double l) const;

 private:
  struct NodeSeries {
    std::array<Series, 3> n;
    Series square;
    double reach;
  };
  NodeSeries series(const Node& at) const;
  NodeSeries series_of(const Node& node) const;
  static Node after(const Node& at, const NodeSeries& s, double h);
  void follow(const Node& start);

  double c_, k_;
  std::vector<Node> nodes_;
  std::vector<NodeSeries> series_;  // of the nodes, once all are there
  double period_ = HUGE_VAL;
  Node sums_{};  // of a period
};

}  // namespace domefall
