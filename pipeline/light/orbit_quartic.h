// A ray's orbit about a charge obeys (dw/dphi)^2 = P(w), where w = 1/r and P(w) = 1/b^2 - w^2 + 2 w^3
// - q^2 w^4 (M = 1).  This file factorises P and integrates over it.
//
// Light with b < kappa passes the circle of light: P has a pair of complex roots there, one root
// below w = 0 and one inside, w_4, where light turns back from the core.  With b > kappa the pair is
// real, and light from the sky turns back at its lower root.
#pragma once

#include <array>
#include <complex>

namespace domefall {

// A LightCircle is what the orbits of a charge have in common.
struct LightCircle {
  long double charge;
  bool exists;  // q^2 <= 9/8
  // w of the circle, and P = eps + second x^2 + third x^3 - q^2 x^4 about it.
  long double w = 0, second = 0, third = 0;
};
LightCircle light_circle_of(long double charge);

class OrbitQuartic {
 public:
  // Takes 1/b, eps = 1/b^2 - 1/kappa^2 (1/b^2 where light cannot circle) and the observer's place:
  // w, w less that of the circle, and P(w).
  OrbitQuartic(const LightCircle& circle, long double inverse_b, long double eps, long double w,
               long double above_circle, long double p_observer);

  // Returns the azimuth between the sky, w = 0, and the observer, without turning on the way.
  long double direct() const;
  // Returns the azimuth from the sky to the turning point, which is w_4 or, where b > kappa, the
  // lower root of the pair, and from there to the observer.
  long double turned() const;

 private:
  using Complex = std::complex<long double>;
  // A Factor is constant + slope x.
  struct Factor {
    Complex constant;
    long double slope;
  };
  using Roots = std::array<Complex, 4>;  // of the factors at a place

  void factorise_at_circle(const LightCircle& circle, long double eps);
  void factorise_passing(long double q, long double inverse_b);
  void factorise_turning(const LightCircle& circle, long double inverse_b);
  Roots at_observer(long double p_observer) const;
  Roots at(long double x) const;
  Roots at_turn() const;
  long double integral(const Roots& high, const Roots& low, long double width) const;

  // The first two factors are of complex conjugates, or all are real.  The last vanishes at the
  // turning point.  Places are counted from `origin_`, in w.
  std::array<Factor, 4> factors_{};
  bool conjugate_ = false;
  long double origin_ = 0, w_ = 0, x_ = 0;
  Roots observer_{};
};

}  // namespace domefall
