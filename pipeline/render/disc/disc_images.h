// Where an observer sees the rings of a disc, tabulated once for its radius.
//
// A ray is known by p = k^r/L (M = 1), the slope dw/dpsi of w = 1/r at the observer, counted along
// the angle psi that the ray sweeps back in time: it is at w(psi; p), whatever the sign of its
// energy.  For a fixed psi, w grows with p.  So the image of the rings between two radii is, at
// each psi, one interval of p: from that of the outer rim to that of the inner one.  Along psi
// these curves are smooth, through the silhouette's edge too: an image of higher order is the same
// interval half a turn farther on, only narrower, by e^-pi for each half turn.  At psi = 0 p is
// infinite; p psi/(1 + psi) is tabulated, which is not.
#pragma once

#include <vector>

#include "pipeline/optics/radius.h"

namespace domefall {

class DiscImages {
 public:
  // Images of that many half turns.  More are seen by no pixel: the fifth is 4e-6 radians wide.
  static constexpr int kOrders = 5;

  // Of the rings inner <= r <= outer (M), 2 <= inner, for an observer at 0 < r < infinity in the
  // rain frame or, `outgoing`, in that of free fall to infinity; or, where light goes straight, in
  // that of rest, r > 2.  `with_times`: moment() will be
  // asked for, which where light goes straight has no time.
  DiscImages(const Radius& at, bool outgoing, bool straight, double inner, double outer,
             bool with_times = false);

  // How many half turns there are: one where light goes straight.
  int orders() const { return orders_; }

  struct Interval {
    double low, high;              // p of the outer rim, and of the inner one
    double low_slope, high_slope;  // d/dpsi
  };
  // 0 < psi < orders() pi.  Measured over 0.5 <= r <= 1e4: within 2e-7 (1 + |p|) of the exact rays.
  Interval interval(double psi) const;
  // The least p and the greatest that the image of an order has anywhere.  Order 0 has neither.
  double least(int order) const { return least_[static_cast<std::size_t>(order)]; }
  double greatest(int order) const { return greatest_[static_cast<std::size_t>(order)]; }

  // 1/r at that psi on the ray that lies by the part u (0 to 1) of the interval above its low end.
  double inverse_radius(double psi, double u) const;

  // A place there: 1/r, and when its light set out, as RayTimes has it (M), with what both change
  // by for each unit of u.
  struct Moment {
    double w, w_slope, time, time_slope;
  };
  Moment moment(double psi, double u) const;

 private:
  static constexpr int kPerHalfTurn = 64;  // nodes of psi
  static constexpr int kParts = 24;        // intervals of u

  void tabulate(const Radius& at, bool outgoing, bool with_times);

  bool straight_;
  int orders_;
  double observer_w_, inner_w_, outer_w_;
  std::vector<double> low_, high_;  // p psi/(1 + psi) at the nodes of psi
  std::vector<float> w_;            // at each node of psi, kParts + 1 values
  std::vector<double> times_;       // likewise; empty if not asked for
  std::vector<double> least_, greatest_;
};

}  // namespace domefall
