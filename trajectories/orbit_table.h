// An OrbitTable holds proper time, azimuth and null time along an orbit's curve.  They are plain
// quadratures, done once, as Chebyshev series over panels that are halved until the last terms of
// the integrands vanish.  It also has the inverse, the parameter of a proper time.
//
// Each panel counts from the nearest in time of the places where an orbit is quick, which are the
// two singularities, a periastron and the origin.  So a place next to one of them keeps its digits,
// however long ago the origin was.  A singularity is taken to be at r = 1e-16 M, which at 1e-6 M is
// 1e-15 of the time to it.
#pragma once

#include <cstddef>
#include <vector>

#include "trajectories/chebyshev_panel.h"
#include "trajectories/double_double.h"
#include "trajectories/orbit_curve.h"

namespace domefall {

class OrbitTable {
 public:
  // Makes the table, in which all three are 0 at the parameter `origin`.  Up to `turn` the null
  // time is u = t - r*, and from there on v = t + r*, of one t, so that v - u = 2 r* there.  With
  // turn = -infinity it is v throughout, and with infinity u.  For E = 0 the null time is left 0,
  // because it is not finite at the turn.  The tolerance is of the integrands, relative to the
  // largest of their panel.  Throws std::domain_error if the orbit is beyond what doubles can
  // square or the table reaches.  Throws std::runtime_error if the panels become too many, which no
  // orbit has been seen to do.
  OrbitTable(const OrbitCurve& curve, double origin, double turn, double tolerance);

  struct Sums {
    double tau = 0, azimuth = 0, null_time = 0;
  };
  struct Place {
    ProperTime tau;
    double azimuth = 0;
    DoubleDouble null_time;
  };
  Place at(double s) const;
  double parameter(const ProperTime& tau) const;  // of tau clamped to what is tabulated
  // These are the values at the ends.  tau is exactly that of at() where the end is a singularity.
  const Sums& begin() const { return begin_; }
  const Sums& end() const { return end_; }
  std::size_t panel_count() const { return panels_.size(); }

 private:
  struct Panel {
    double low = 0, high = 0;
    ProperTime begin_tau;
    Sums anchor;  // at the place that the panel counts from
    Sums from;    // since the anchor, at the panel's end that is nearer to it
    PanelIntegral tau, azimuth, null_time;  // what is added since that end
  };
  using Panels = std::vector<Panel>::iterator;

  Sums rates(double s, bool ingoing, double& noise) const;
  bool fill(Panel& panel) const;
  void append(double low, double high, int depth);
  std::vector<double> anchors(double origin) const;
  Panels from_parameter(double s);
  Sums risen(const Sums& from, const Panel& panel) const;
  Sums count_up(Panels first, Panels last, const Sums& anchor) const;
  Sums count_down(Panels first, Panels last, const Sums& anchor) const;
  Sums count_between(Panels first, Panels last, const Sums& known, bool known_is_first);
  void sum_up(double origin);

  OrbitCurve curve_;
  double turn_, tolerance_;
  double jump_ = 0;  // of the null time at the turn
  std::vector<Panel> panels_;
  Sums begin_, end_;
};

}  // namespace domefall
