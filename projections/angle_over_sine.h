// This file finds theta/sin(theta) from cos(theta), which takes a direction to its place on a
// Domemaster.
#pragma once

#include <array>

namespace domefall {

inline constexpr double kLeastCosine = -0.3;  // down to which the polynomial holds

// Returns acos(z)/sqrt(1 - z^2), which is 1 at z = 1, for z in [kLeastCosine, 1].  It is a
// polynomial of degree 16 in (z - 0.35)/0.65, cut from the Chebyshev series, so it has no branch
// and no division.  The measured relative error is below 5e-11.
inline double angle_over_sine(double z) {
  constexpr std::array<double, 17> kOf{
      1.295143434229534,       -0.40496281255986318,    0.1543082493254066,
      -0.063311696064396413,   0.026997738977406107,    -0.01178727872722951,
      0.0052290754994800173,   -0.0023499959766855281,  0.0010648208477053771,
      -0.00047410849105511549, 0.00021502791024796963,  -0.0001201114910137191,
      5.8117048501959978e-05,  -4.1687291331471421e-06, 3.2035013914910593e-07,
      -1.3157918768635923e-05, 6.5458095627413115e-06};
  const double t = (z - 0.35) * (1 / 0.65);
  double sum = kOf[16];
  for (int k = 15; k >= 0; --k) sum = sum * t + kOf[k];
  return sum;
}

}  // namespace domefall
