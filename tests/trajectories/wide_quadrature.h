// Quadrature with 50 digits, to some 20 of them, of what may be singular at both ends: the trapezoidal
// rule along t with x = middle + half tanh(pi/2 sinh t) (Takahasi and Mori 1974), over pieces.
#pragma once

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace domefall {

using Digits = boost::multiprecision::cpp_bin_float_50;

// Takes a function that returns an array of numbers, and returns the integrals of all.
template <std::size_t N, class Function>
std::array<double, N> wide_integrals(const Function& f, const Digits& low, const Digits& high,
                                     int pieces) {
  constexpr int kSteps = 140;  // on each side
  const Digits step = Digits(1) / 36, half = (high - low) / (2 * pieces),
               half_pi = boost::math::constants::half_pi<Digits>();
  std::array<Digits, N> sums{};
  const auto add = [&](const Digits& x, const Digits& weight) {
    const std::array<Digits, N> values = f(x);
    for (std::size_t n = 0; n < N; ++n) sums[n] += weight * values[n];
  };
  for (int k = 0; k <= kSteps; ++k) {
    const Digits t = k * step, e = exp(Digits(-2 * half_pi * sinh(t))), part = 2 * e / (1 + e);
    // That of the middle, which is reached from both sides, counts by halves.
    const Digits weight = half_pi * cosh(t) * part * (2 - part) / (k == 0 ? 2 : 1);
    for (int piece = 0; piece < pieces; ++piece) {
      add(Digits(low + half * (2 * piece + part)), weight);
      add(Digits(low + half * (2 * (piece + 1) - part)), weight);
    }
  }
  std::array<double, N> result{};
  for (std::size_t n = 0; n < N; ++n) result[n] = static_cast<double>(sums[n] * half * step);
  return result;
}

}  // namespace domefall
