// The tables of this file say where an observer sees rings in a plane through the hole.  They are
// made once for the observer's radius.
//
// Followed back in time, a ray sweeps the angle psi.  It is labelled by p = k^r/L (M = 1), which is
// the slope dw/dpsi of w = 1/r at the observer.  The label fixes w(psi; p), whatever the sign of
// the ray's energy.  For a fixed psi, w grows with p.  So at each psi the image of the rings
// between two radii is one interval of p, from the p of the outer rim to that of the inner one.
// Along psi the two ends are smooth curves, across the silhouette's edge too.  An image of higher
// order is the same interval half a turn farther on, narrower by e^-pi for each half turn.  At psi
// = 0 the ends are infinite, so p psi/(1 + psi) is tabulated, which stays finite.
#pragma once

#include <vector>

#include "pipeline/light/sky_table.h"
#include "pipeline/spacetime/spacetime.h"

namespace domefall {

// A PlaneView is the frame in which an observer sees a plane: that of free fall near a hole without
// charge, and T near a charge (charged.h), which falls as well.  If light goes `straight`, the
// observer is at rest outside.
struct PlaneView {
  Spacetime space;  // Schwarzschild's or a charge's
  Radius at;        // 0 < r < infinity, with its distances near a hole without charge
  Tetrad tetrad;    // of rain or its mirror image near a charge
  bool straight = false;

  // Returns the law of the energy, which is never straight light's.
  ViewEnergy energy() const;
  double tortoise() const;       // r*
  double lapse_squared() const;  // f; the observer is outside where light is straight
};

class PlaneImages {
 public:
  // The number of images, one for each half turn.  No pixel sees more, since the fifth is 4e-6
  // radians wide.
  static constexpr int kOrders = 5;

  // The rings are those of inner <= r <= outer (M), from the horizon on.  `with_times` says that
  // moment() will be called.  Where light goes straight, its times are 0.
  PlaneImages(const PlaneView& view, double inner, double outer, bool with_times = false);

  // Returns the number of half turns, which is one where light goes straight.
  int orders() const { return orders_; }

  // An Interval is the image of the rings at one psi.
  struct Interval {
    double low, high;              // p of the outer rim, and of the inner one
    double low_slope, high_slope;  // d/dpsi
  };
  // Returns the image at 0 < psi < orders() pi.  Measured over 0.5 <= r <= 1e4, it is within
  // 2e-7 (1 + |p|) of the exact rays.
  Interval interval(double psi) const;
  // These return the least p and the greatest p that the image of an order has at any psi.  Order 0
  // has no such bounds, and they are infinite.
  double least(int order) const { return least_[static_cast<std::size_t>(order)]; }
  double greatest(int order) const { return greatest_[static_cast<std::size_t>(order)]; }

  // Returns 1/r at psi on the ray whose p is low + u (high - low) of the interval, 0 <= u <= 1.
  double inverse_radius(double psi, double u) const;

  // A Moment holds w = 1/r of a place on the plane, the time at which its light set out, as RayTimes
  // counts it (M), and the derivatives of both by u.
  struct Moment {
    double w, w_slope, time, time_slope;
  };
  // Returns the moment of the place that inverse_radius() describes.
  Moment moment(double psi, double u) const;

 private:
  static constexpr int kPerHalfTurn = 64;  // nodes of psi
  static constexpr int kParts = 24;        // intervals of u

  void tabulate(const PlaneView& view, bool with_times);
  // Sets least_ and greatest_ from p of the outer rim and of the inner one at each node of psi.
  void bound_orders(const std::vector<double>& low, const std::vector<double>& high);

  bool straight_;
  int orders_;
  double observer_w_, inner_w_, outer_w_;
  std::vector<double> low_, high_;  // p psi/(1 + psi) at the nodes of psi
  std::vector<float> w_;            // at each node of psi, kParts + 1 values
  std::vector<double> times_;       // M, at the same places; empty if not asked for
  std::vector<double> least_, greatest_;
};

}  // namespace domefall
