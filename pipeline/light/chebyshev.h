// Interpolation by polynomials through Chebyshev's nodes, and roots of smooth functions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace domefall {

// Nodes of Chebyshev's on (-std::numbers::pi/2, std::numbers::pi/2), and Lagrange's weights of them at a place.
template <int n>
struct Chebyshev {
  static double node(int k) {
    return std::numbers::pi / 2 * -std::cos(std::numbers::pi * (k + 0.5) / n);
  }
  static std::array<double, n> weights(double x) {
    std::array<double, n> w;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double apart = x - node(k);
      if (apart == 0) {
        w.fill(0);
        w[static_cast<std::size_t>(k)] = 1;
        return w;
      }
      w[static_cast<std::size_t>(k)] =
          (k % 2 == 0 ? 1 : -1) * std::sin(std::numbers::pi * (k + 0.5) / n) / apart;
      sum += w[static_cast<std::size_t>(k)];
    }
    for (double& value : w) value /= sum;
    return w;
  }
};

// Returns the root of f between a, where f > 0, and b, where it is not, by the Illinois method, to a
// part of that range.
template <class F>
double root_between(double a, double fa, double b, double fb, double part, const F& f) {
  const double enough = part * std::abs(b - a);
  for (int n = 0; n < 60 && std::abs(b - a) > enough; ++n) {
    const double c = (a * fb - b * fa) / (fb - fa), fc = f(c);
    if (fc == 0 || std::abs(c - a) < enough || std::abs(c - b) < enough) return c;
    if ((fc > 0) == (fb > 0))
      fa /= 2;
    else
      a = b, fa = fb;
    b = c, fb = fc;
  }
  return b;
}

}  // namespace domefall
