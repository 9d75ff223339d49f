// Lagrange's polynomials through even nodes.
#pragma once

#include <array>
#include <cstddef>

namespace domefall {

// The weights of Lagrange's polynomial through 2n nodes at 1 - n to n for a place from 0 to 1, and their
// derivatives.
template <std::size_t kCount>
struct LagrangeWeights {
  std::array<double, kCount> w, slope;

  explicit LagrangeWeights(double t) {
    static constexpr std::array<double, kCount> kScale = [] {
      std::array<double, kCount> scale{};
      for (std::size_t i = 0; i < kCount; ++i) {
        double product = 1;
        for (std::size_t j = 0; j < kCount; ++j)
          if (j != i) product *= static_cast<double>(i) - static_cast<double>(j);
        scale[i] = 1 / product;
      }
      return scale;
    }();
    // The products of the factors before and after each, and their derivatives.
    std::array<double, kCount + 1> before{1}, before_slope{0}, after{}, after_slope{};
    after[kCount] = 1;
    const auto factor = [t](std::size_t k) {
      return t + (kCount / 2.0 - 1) - static_cast<double>(k);
    };
    for (std::size_t k = 0; k < kCount; ++k) {
      before[k + 1] = before[k] * factor(k);
      before_slope[k + 1] = before_slope[k] * factor(k) + before[k];
      const std::size_t m = kCount - 1 - k;
      after[m] = after[m + 1] * factor(m);
      after_slope[m] = after_slope[m + 1] * factor(m) + after[m + 1];
    }
    for (std::size_t k = 0; k < kCount; ++k) {
      w[k] = kScale[k] * before[k] * after[k + 1];
      slope[k] = kScale[k] * (before_slope[k] * after[k + 1] + before[k] * after_slope[k + 1]);
    }
  }
};

}  // namespace domefall
