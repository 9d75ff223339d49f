// Taylor series of functions that a differential equation gives term by term, and their zeros.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace domefall {

// The terms of a series, of which the last are below rounding within a step.
inline constexpr int kTerms = 24;
using Series = std::array<double, kTerms + 2>;

// Returns the term k of a product.
inline double product(const Series& a, const Series& b, int k) {
  double sum = 0;
  for (int j = 0; j <= k; ++j)
    sum += a[static_cast<std::size_t>(j)] * b[static_cast<std::size_t>(k - j)];
  return sum;
}

inline double value(const Series& s, double x) {
  double sum = 0;
  for (int k = kTerms - 1; k >= 0; --k) sum = sum * x + s[static_cast<std::size_t>(k)];
  return sum;
}
inline double slope(const Series& s, double x) {
  double sum = 0;
  for (int k = kTerms - 1; k > 0; --k) sum = sum * x + k * s[static_cast<std::size_t>(k)];
  return sum;
}
// Returns the integral from 0.
inline double integral(const Series& s, double x) {
  double sum = 0;
  for (int k = kTerms - 1; k >= 0; --k) sum = (sum + s[static_cast<std::size_t>(k)] / (k + 1)) * x;
  return sum;
}
// Returns how far a series is right to rounding, of values of that size.
inline double range(const Series& s, double scale) {
  double longest = HUGE_VAL;
  for (int k = kTerms - 3; k < kTerms; ++k) {
    const double term = std::abs(s[static_cast<std::size_t>(k)]);
    if (term > 0) longest = std::min(longest, std::pow(1e-17 * scale / term, 1.0 / k));
  }
  return longest;
}

// Returns where a function changes its sign between two places.
inline double zero_between(const std::function<double(double)>& f, double a, double b) {
  const bool positive = f(a) > 0;
  for (int k = 0; k < 200; ++k) {
    const double middle = (a + b) / 2;
    if (middle == a || middle == b) break;
    ((f(middle) > 0) == positive ? a : b) = middle;
  }
  return (a + b) / 2;
}

// Returns the last node at or before l, or the first one.
template <class Node, class Time>
const Node& node_before(const std::vector<Node>& nodes, const Time& l) {
  const auto later = std::upper_bound(nodes.begin() + 1, nodes.end(), l,
                                      [](const Time& x, const Node& node) { return x < node.l; });
  return *(later - 1);
}

}  // namespace domefall
