// The radial part of a ray near a spinning hole, over Mino's time l, in which with M = 1 and E = 1
//
//     r'^2 = P^2 - kappa^2 Delta     P = r^2 + a^2 cos^2(theta) - mu
//     phi' = a A - a + ...           A = (P + r')/Delta = kappa^2/(P - r')
//
// (theta the observer's).  A path is followed back in time by a parameter y, of which w = 1/r is such a
// function that the nearest two roots of r'^2 leave no trace in the integrals.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "pipeline/light/dual.h"
#include "pipeline/light/kerr_start.h"

namespace domefall {

// (r'/E)^2 is (rho^2 + b1 rho + b0)(rho^2 + e1 rho + e0), with rho = r - x of the nearest critical ray.
// The first pair of roots has the larger real part.
struct KerrRoots {
  Scaled b1, b0, e1, e0;
  // For a small kappa there are two like pairs, which are not told apart; the factors are nearly those.
  bool alike = false;

  long double discriminant() const { return b1.v * b1.v - 4 * b0.v; }
};
KerrRoots kerr_roots(const KerrStart& start);

// A number T is a double, or a Dual, by delta and by sin(delta) eta.
template <class T>
class KerrPath {
 public:
  KerrPath(const KerrStart& start, const KerrRoots& roots);

  // Where the path starts, and where it ends: in the sky, or on the past horizon.
  double first() const { return value(first_); }
  double last() const { return value(last_); }

  // A Sum is of |E| dl, of the angle psi by which the plane of the ray turns, and of the time v.
  struct Sum {
    T mino = 0, angle = 0, time = 0;
  };
  // Returns the whole path's, to the sky, without its time.  The angle is that of light that falls,
  // for E > 0.
  Sum whole() const;
  // Returns that from one place to another one.  `sign` is E's.
  Sum between(double from, double to, double sign) const;
  // The same from the start to a place, with the derivatives at that y.
  Sum up_to(double y, double sign) const;
  T inverse_radius(double y) const { return node(y).w; }
  // Returns only the Mino time.
  double mino_between(double from, double to) const;
  // Moves on to the place of a Mino time, from one at `y` whose time is `mino`, by Newton's method.
  void move_to(double target, double& y, double& mino) const;

  struct Place {
    double r, speed;  // r'/|E|, of the photon
    double by_y;      // |E| dl/dy
  };
  Place place(double y) const;

 private:
  enum class Shape { kPlain, kOuter, kInner, kComplex };
  struct Node {
    T w, mino, p, speed, delta;  // the last three are times w^2
  };

  void set_shape(const KerrStart& start, const KerrRoots& roots);
  void set_map(const KerrStart& start, const KerrRoots& roots, const Scaled& product);
  void set_ends(const KerrStart& start);
  void add_singular(std::complex<double> w);
  Node node(double y) const;
  Sum rates(double y, double sign, bool all) const;
  template <class Add>
  void over_panels(double from, double to, std::size_t singular, const Add& add) const;

  Shape shape_ = Shape::kPlain;
  bool to_sky_;
  double spin_, squares_, sigma_;
  double x_, below_outer_, above_inner_;      // x - r_+, x - r_-
  T kappa2_, mu_;                             // kappa^2, mu
  T w1_ = 0, gap_ = 0, root_ = 0, rho1_ = 0;  // see node()
  T e1_ = 0, e0_ = 0, last_start_ = 0, p_ = 0;
  double direction_ = 1;
  T first_ = 0, last_ = 0;
  // The places y at which integrands are singular: first those of Mino's time and then, up to
  // of_angle_, those of the angle.
  std::vector<std::complex<double>> singular_;
  std::size_t of_mino_ = 0, of_angle_ = 0;
};

extern template class KerrPath<double>;
extern template class KerrPath<Dual>;

}  // namespace domefall
