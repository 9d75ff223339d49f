// A FlightTable holds the proper time and the null time to the end of a flight with engines, along
// a parameter q that is 0 at the end and 1 at the beginning.  Both are plain quadratures, done
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
  };

  // Takes the derivatives of both times by q, which are positive and smooth but for a kink at each
  // of `kinks`, in (0, 1) and in their order.  Throws std::domain_error if the panels become too
  // many, which no flight has been seen to need.
  FlightTable(const std::function<Times(double)>& rates, std::vector<double> kinks = {});

  Times to_go(double q) const;
  // Returns the q with that proper time to go, or the nearer end for one that is not between them.
  double parameter(double tau_to_go) const;
  Times whole() const { return whole_; }

 private:
  struct Panel {
    double low, high;
    Times from;
    PanelIntegral tau, null_time;
  };

  void append(const std::function<Times(double)>& rates, double low, double high, int depth);

  std::vector<Panel> panels_;
  Times whole_;
};

}  // namespace domefall
