// Interpolation by polynomials through Chebyshev's nodes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace domefall {

// Chebyshev's nodes on (-pi/2, pi/2), and Lagrange's weights of them at a place.
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

}  // namespace domefall
