// Blurs light on the whole sphere alike in every direction, by spherical harmonics.
//
// The light lies on a grid of rows of equal colatitude theta (row j at (j + 1/2) pi/rows) and of columns
// of equal longitude.  With the orthonormal harmonics Y_lm, a kernel that depends on the angle alone
// multiplies the coefficient of each Y_lm by a number k_l, so that a blur has neither seams nor poles,
// and keeps all light where k_0 = 1.  A Gaussian of the standard deviation sigma has (the heat kernel)
//
//     k_l = exp(-l (l + 1) sigma^2/2).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "projections/projection.h"

namespace domefall {

class SphereBlur {
 public:
  // Gaussians from this width on (radians) are resolved, whose k_l are below exp(-8) where the sum
  // ends.  The grid's steps are half as wide.
  explicit SphereBlur(double least_sigma);

  // What adding and reading between four points of the grid widen a Gaussian by, as a variance.
  double own_variance() const { return step_ * step_ / 3; }
  // The number of orders l.
  int orders() const { return orders_; }

  using Rgb = std::array<float, 3>;
  // A Place is where a direction lies on the grid.
  struct Place {
    int row, column;     // of the point before it; -1 is the row beyond the pole
    float down, across;  // to the next one, 0 to 1
  };
  Place place(const CameraDirection& n) const;
  // Adds light, which is radiance times solid angle.
  void add(const Place& place, const Rgb& light);
  // Replaces the light by the blurred radiance.  There is one k_l for each order.
  void blur(std::span<const double> kernel);
  Rgb at(const Place& place) const;

 private:
  std::array<std::size_t, 4> points(const Place& place) const;

  int orders_, rows_, columns_;
  double step_;
  std::vector<Rgb> grid_;  // [row][column]
};

}  // namespace domefall
