// Proper time, azimuth and null time along an orbit's curve: plain quadratures, done once, as
// Chebyshev series over panels that are halved until the last terms of the integrands vanish; and
// the inverse, the parameter of a proper time.
#pragma once

#include <cstddef>
#include <vector>

#include "trajectories/chebyshev_panel.h"
#include "trajectories/orbit_curve.h"

namespace domefall {

class OrbitTable {
 public:
  // All three are 0 at the parameter `origin`.  Up to `turn` the null time is u = t - r*, from
  // there on v = t + r*, of one t: v - u = 2 r* there.  turn = -infinity: v throughout; infinity:
  // u.  Of E = 0 the null time is left 0: it is not finite at the turn.  Throws std::domain_error
  // if the orbit is beyond what doubles can square or the table reaches, and std::runtime_error if
  // the panels become too many, which no orbit has been seen to do.  tolerance: of the integrands,
  // relative to the largest of their panel.
  OrbitTable(const OrbitCurve& curve, double origin, double turn, double tolerance);

  struct Sums {
    double tau = 0, azimuth = 0, null_time = 0;
  };
  Sums at(double s) const;
  double parameter(double tau) const;  // of tau clamped to what is tabulated
  const Sums& begin() const { return begin_; }
  const Sums& end() const { return end_; }
  std::size_t panel_count() const { return panels_.size(); }

 private:
  struct Panel {
    double low = 0, high = 0;
    double begin_tau = 0;
    Sums from;                              // at the end nearer to the origin
    PanelIntegral tau, azimuth, null_time;  // what is added since
  };

  Sums rates(double s, bool ingoing, double& noise) const;
  bool fill(Panel& panel) const;
  void append(double low, double high, int depth);
  void sum_up(double origin, double turn);
  Sums in_panel(const Panel& panel, double x) const;

  OrbitCurve curve_;
  double turn_, tolerance_;
  std::vector<Panel> panels_;
  Sums begin_, end_;
};

// r + 2 ln |r/2 - 1|, of r and r - 2.
double tortoise(double r, double over_two);

}  // namespace domefall
