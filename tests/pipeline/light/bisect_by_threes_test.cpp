#include "pipeline/light/bisect_by_threes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <set>

namespace domefall {
namespace {

template <class IsBeyond>
double plainly_bisected(double low, double high, const IsBeyond& is_beyond) {
  for (int halving = 0; halving < kMostBisections; ++halving) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) return middle;
    (is_beyond(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

// Counts the calls, each of which looks at all points of three halvings.
template <class IsBeyond>
double bisected(double low, double high, const IsBeyond& is_beyond, int* calls = nullptr) {
  return bisect_by_threes(low, high, [&](const std::array<double, kHalvingPoints>& points) {
    if (calls) ++*calls;
    std::array<bool, kHalvingPoints> beyond;
    for (std::size_t k = 0; k < points.size(); ++k) beyond[k] = is_beyond(points[k]);
    return beyond;
  });
}

TEST(BisectByThrees, FindsToTheBitWhatPlainBisectionFinds) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  std::set<double> found;
  constexpr int kPlaces = 2000;
  for (int n = 0; n < kPlaces; ++n) {
    const double low = -45 * part(random), high = 6.4 * part(random);
    const double place = low + (high - low) * part(random);
    const auto is_beyond = [&](double x) { return std::expm1(x) > std::expm1(place); };
    const double plain = plainly_bisected(low, high, is_beyond);
    EXPECT_EQ(bisected(low, high, is_beyond), plain) << low << " " << high << " " << place;
    found.insert(plain);
  }
  EXPECT_GT(found.size(), kPlaces / 2U);
}

// What is beyond depends on the bits of a point, so that the halvings go any way.
TEST(BisectByThrees, GoesTheSameWayWhereTheFunctionIsNotMonotone) {
  for (std::uint64_t factor = 1; factor < 4000; factor += 2) {
    const auto is_beyond = [&](double x) {
      return (std::bit_cast<std::uint64_t>(x) * factor * 0x9E3779B97F4A7C15U) >> 63 != 0;
    };
    EXPECT_EQ(bisected(-45, 6.4, is_beyond), plainly_bisected(-45, 6.4, is_beyond)) << factor;
  }
}

// Near 0 doubles are so dense that the bound on the halvings ends them, and next to one another
// they have no middle at any of the three levels.
TEST(BisectByThrees, EndsWherePlainBisectionEnds) {
  const auto always = [](double) { return true; };
  const auto never = [](double) { return false; };
  int calls = 0;
  EXPECT_EQ(bisected(0, 1, always, &calls), std::ldexp(1.0, -kMostBisections - 1));
  EXPECT_EQ(calls, kMostBisections / kHalvingsTogether);
  EXPECT_EQ(plainly_bisected(0, 1, always), std::ldexp(1.0, -kMostBisections - 1));
  constexpr double kStep = std::numeric_limits<double>::epsilon();
  for (int steps = 0; steps <= 20; ++steps)
    for (const auto& is_beyond : {std::function<bool(double)>(always), {never}}) {
      const double high = 1 + steps * kStep;
      calls = 0;
      EXPECT_EQ(bisected(1, high, is_beyond, &calls), plainly_bisected(1, high, is_beyond))
          << steps;
      // As many as halve `steps` to nothing.
      EXPECT_LE(calls, 2) << steps;
    }
}

}  // namespace
}  // namespace domefall
