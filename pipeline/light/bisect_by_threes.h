// This bisection is for functions that cost as much at one point as at several.
#pragma once

#include <array>
#include <cstddef>

namespace domefall {

// The function is looked at in the middles of three successive halvings, whichever way each goes.
inline constexpr int kHalvingsTogether = 3;
inline constexpr std::size_t kHalvingPoints = (1 << kHalvingsTogether) - 1;

inline constexpr int kMostBisections = 102;
static_assert(kMostBisections % kHalvingsTogether == 0);

// Halves the range from `low` to `high` until it has no middle, at most kMostBisections times, and
// returns the middle of what is left, to the bit as if the points were looked at one by one.
// `beyond` takes a std::array<double, kHalvingPoints> and returns for each whether it lies beyond
// the place that is sought, as a std::array<bool, kHalvingPoints>.
template <class Beyond>
constexpr double bisect_by_threes(double low, double high, const Beyond& beyond) {
  struct Part {
    double low, high;
    constexpr double middle() const { return (low + high) / 2; }
    constexpr Part half(bool lower) const {
      return lower ? Part{low, middle()} : Part{middle(), high};
    }
  };
  Part part{low, high};
  for (int step = 0; step < kMostBisections; step += kHalvingsTogether) {
    // Node k of the tree of parts has the nodes 2 k + 1 and 2 k + 2 below it.
    std::array<Part, kHalvingPoints> tree{part};
    for (std::size_t k = 1; k < tree.size(); ++k) tree[k] = tree[(k - 1) / 2].half(k % 2 == 1);
    std::array<double, kHalvingPoints> middles{};
    for (std::size_t k = 0; k < tree.size(); ++k) middles[k] = tree[k].middle();
    const std::array<bool, kHalvingPoints> lower = beyond(middles);
    for (std::size_t k = 0; k < tree.size(); k = 2 * k + (lower[k] ? 1 : 2)) {
      if (middles[k] == tree[k].low || middles[k] == tree[k].high) return middles[k];
      part = tree[k].half(lower[k]);
    }
  }
  return part.middle();
}

}  // namespace domefall
