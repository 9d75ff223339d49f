// A FlightTable holds the proper time, the null time and the azimuth to the end of a flight, along a
// parameter q that is 0 at the end and 1 at the beginning.  They are plain quadratures, done
// once, as Chebyshev series over panels that are halved until the last terms of the integrands
// vanish.  They count from the end, since a flight comes from far away, slowly, to where things are
// quick.
#pragma once

#include <functional>
#include <vector>

#include "trajectories/chebyshev_panel.h"

namespace domefall {

class FlightTable {
 public:
  struct Times {
    double tau = 0, null_time = 0;  // M
    double azimuth = 0;             // radians
  };

  // Takes the derivatives by q, of which that of tau is positive.  They are smooth but for a kink at each
  // of `kinks`, in (0, 1) and in their order, and rounded by less than the tolerance, relative to the
  // largest of a panel.  Throws std::domain_error if the panels become too many, which no flight has
  // been seen to need.
  static constexpr double kTolerance = 1e-14;
  FlightTable(const std::function<Times(double)>& rates, std::vector<double> kinks = {},
              double tolerance = kTolerance);

  Times to_go(double q) const;
  // Returns the q with that proper time to go, or the nearer end for one that is not between them.
  double parameter(double tau_to_go) const;
  Times whole() const { return whole_; }

 private:
  struct Panel {
    double low, high;
    Times from;
    PanelIntegral tau, null_time, azimuth;
  };

  void append(const std::function<Times(double)>& rates, double low, double high, int depth);
  // Returns the last panel for which begin(panel) is not beyond a value.
  template <class Begin>
  const Panel& panel_at(double value, const Begin& begin) const;

  double tolerance_;
  std::vector<Panel> panels_;
  Times whole_;
};

}  // namespace domefall
