// ChargedPaths say where the rays of an observer near a charge are after having swept an angle, and
// when the light set out there, many at a time.  They are for places of region I, and between
// the horizons for those from where light falls in; ray_orbits.h and ray_times.h say the same of a
// hole without charge.
//
// With w = 1/r and the angle psi, an orbit obeys
//
//     w'' = -w + 3 w^2 - 2 q^2 w^3,
//
// whose Taylor series follows term by term.  A ray is known by its w' = p = k^r/L at the observer.
// The time is a sum over the same steps: light that moves out keeps u = t - r* but for N, and light
// that falls keeps v = t + r*, where N = int dpsi/(e + |w'|), e = E/L, as in orbit_time.h.
#pragma once

#include <array>

#include "pipeline/spacetime/charged.h"

namespace domefall {

class ChargedPaths {
 public:
  static constexpr int kSize = 128;
  using Column = std::array<double, kSize>;
  struct Places {
    // w = 1/r (1/M).  It is 0 where the ray has ended on a sky, and infinite where it has come to
    // the past horizon.
    alignas(64) Column w;
    alignas(64) Column slope;  // dw/dpsi; 0 where the ray has ended
    // v at the place less that at the observer, M.  It is -infinity on the past horizon, and set
    // only by timed().
    alignas(64) Column time;
  };

  // The observer is at r above the inner horizon, and sees in the tetrad T.
  ChargedPaths(const ChargedHole& hole, double r);

  // Finds the places on count <= kSize rays, given by p and e, after psi[k] >= 0.  Between the
  // horizons p is negative.  Measured against small steps in long double, the error of w is below
  // 1e-13 exp(psi); neighbouring rays part by exp(psi), too.  A ray of 8 radians takes 0.7 us, or 1
  // us with its time (AVX-512).
  void find(const double* p, const double* e, const double* psi, int count, Places& places) const;
  void timed(const double* p, const double* e, const double* psi, int count, Places& places) const;

  const ChargedHole& hole() const { return hole_; }

 private:
  void follow(const double* p, const double* e, const double* psi, int count, bool with_times,
              Places& places) const;
  double time(bool inwards, double delay, double turn_w, double w) const;

  ChargedHole hole_;
  double w_, horizon_w_, charge_squared_, tortoise_;
};

}  // namespace domefall
