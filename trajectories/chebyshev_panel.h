// These are integrals of a smooth function over a panel, as Chebyshev series.  The function is
// sampled at the nodes of the first kind, integrated term by term, and evaluated by Clenshaw's
// recurrence.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace domefall {

inline constexpr int kPanelTerms = 20;  // of the integrand
using PanelValues = std::array<double, kPanelTerms>;
using PanelIntegral = std::array<double, kPanelTerms + 1>;

// PanelNodes hold cos(k acos(x_j)) at the nodes x_j = cos(pi (j + 1/2)/N), which panel_node(j)
// gives.
struct PanelNodes {
  std::array<PanelValues, kPanelTerms> cosine{};
  PanelNodes() {
    for (std::size_t k = 0; k < kPanelTerms; ++k)
      for (std::size_t j = 0; j < kPanelTerms; ++j)
        cosine[k][j] = std::cos(std::numbers::pi * double(k) * (double(j) + 0.5) / kPanelTerms);
  }
};

inline const PanelNodes& panel_nodes() {
  static const PanelNodes made;
  return made;
}

inline double panel_node(std::size_t j) { return panel_nodes().cosine[1][j]; }

// Finds the integral from x = -1 of the function with these values at the nodes, times `half`.
// Returns false if the last two terms, over the largest value, exceed the tolerance.  Then the
// nodes are too few.
inline bool integrate_panel(const PanelValues& values, double half, double tolerance,
                            PanelIntegral& integral) {
  std::array<double, kPanelTerms + 2> c{};
  double largest = 0;
  for (std::size_t k = 0; k < kPanelTerms; ++k) {
    double total = 0;
    for (std::size_t j = 0; j < kPanelTerms; ++j) total += values[j] * panel_nodes().cosine[k][j];
    c[k] = total * 2 / kPanelTerms;
  }
  for (const double value : values) largest = std::max(largest, std::abs(value));
  integral[0] = 0;
  for (std::size_t k = 1; k <= kPanelTerms; ++k) {
    integral[k] = half * (c[k - 1] - c[k + 1]) / (2 * double(k));
    integral[0] += k % 2 == 1 ? integral[k] : -integral[k];
  }
  return std::abs(c[kPanelTerms - 1]) + std::abs(c[kPanelTerms - 2]) <= tolerance * largest;
}

inline double panel_sum(const PanelIntegral& c, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t k = kPanelTerms; k > 0; --k) {
    const double b0 = c[k] + 2 * x * b1 - b2;
    b2 = b1, b1 = b0;
  }
  return c[0] + x * b1 - b2;
}

}  // namespace domefall
