// A WormholeLeg is the part of a geodesic of a wormhole's space between infinity and where it turns,
// or, if it passes the throat, the mouth.  Time runs alike everywhere, so light and everything that
// falls freely, at an even speed, run along the same curves, of which the impact parameter b tells
// one from another:
//
//     d(azimuth)/ds = b/r^2      (dl/ds)^2 = 1 - b^2/r^2      s: proper length
//
// The leg is given by u >= 0, with |l| - a = y_t cosh u for b > 1, which turns at r = b, and s sinh u
// for |b| < 1, which passes.  In u all rates are smooth: their singularities are nearly pi/2 from the
// real axis or further.
#pragma once

#include "pipeline/spacetime/wormhole.h"

namespace domefall {

class WormholeLeg {
 public:
  // Takes b and 1 - b, of which b > -1 gives the sense of turning.  1 - b = 0 is taken as a little
  // more, so that it is a leg that nearly ends at the throat.
  WormholeLeg(const Wormhole& wormhole, double b, double one_minus_b);

  struct Place {
    double y;  // |l| - a, >= 0
    double r;
    double rise;  // r^2 - b^2 over r^2, (dl/ds)^2
    double rate;  // ds/du, for u > 0
  };
  Place at(double u) const;
  // Returns the u of y, given with r - b >= 0 there, which is used beside a turn, so that it is right
  // to rounding there.
  double parameter(double y, double r_less_b) const;

  bool turns() const { return turns_; }
  double impact() const { return b_; }
  // Returns the u beyond which there is only the way to infinity, whose length grows like exp(u).
  double calm() const;
  // Returns ds of dl in the cylinder, which only a leg with |b| < 1 has.
  double cylinder_rate() const;

 private:
  bool ellis_, turns_;
  double m_, unit_;  // of dngr: x = y/unit
  double b_, below_;
  double scale_;  // y_t or s
};

}  // namespace domefall
