#include "pipeline/show/rate_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/show/curve.h"

namespace domefall {
namespace {

struct Ends {
  double begin, end;
};

std::vector<Ends> many_ends() {
  std::vector<Ends> ends;
  for (const double begin : {0.0, 1e-9, 0.3, 1.0, 1.7, 2.0, 5.0, 400.0, 1e9})
    for (const double end : {0.0, 1e-9, 0.3, 1.0, 1.7, 2.0, 5.0, 400.0, 1e9})
      ends.push_back({begin, end});
  return ends;
}

TEST(RateLaws, PassFromTheBeginningToTheEndWithoutGoingBack) {
  for (const auto& [begin, end] : many_ends()) {
    EXPECT_EQ(part_passed(begin, end, 0), 0);
    EXPECT_NEAR(part_passed(begin, end, 1), 1, 1e-14) << begin << " " << end;
    double before = 0;
    for (int k = 1; k <= 1000; ++k) {
      const double passed = part_passed(begin, end, k / 1000.0);
      EXPECT_GE(passed, before - 1e-15) << begin << " " << end << " at " << k;
      before = passed;
    }
  }
}

TEST(RateLaws, HaveTheRatesThatAreGivenAtBothEndsAndNoKinkThere) {
  for (const auto& [begin, end] : many_ends()) {
    if (begin + end > 1000) continue;  // it changes within less than the steps below
    const double step = 1e-9;
    EXPECT_NEAR(part_passed(begin, end, step) / step, begin, 1e-5 * (1 + begin)) << begin << end;
    EXPECT_NEAR(part_passed(end, begin, step) / step, end, 1e-5 * (1 + end)) << begin << end;
    // The rate of the stretch from h to 2 h differs from that at 0 by the square of h only.
    const auto bend = [first = begin, last = end](double h) {
      return part_passed(first, last, 2 * h) / h - 2 * part_passed(first, last, h) / h;
    };
    const double h = 1e-4 / (1 + begin + end);
    if (std::abs(bend(h)) > 1e-9) {
      EXPECT_NEAR(bend(2 * h) / bend(h), 4, 0.1) << begin << " " << end;
    }
  }
}

TEST(RateLaws, RunBackwardsAreThoseOfTheSwappedEnds) {
  for (const auto& [begin, end] : many_ends())
    for (const double x : {1e-6, 0.01, 0.3, 0.5, 0.77, 0.999})
      EXPECT_NEAR(part_passed(begin, end, x) + part_passed(end, begin, 1 - x), 1, 1e-13)
          << begin << " " << end << " at " << x;
}

TEST(RateLaws, ContainThePacesThatHaveNames) {
  for (const double x : {0.1, 0.25, 0.5, 0.9}) {
    EXPECT_NEAR(part_passed(1, 1, x), x, 1e-15) << "steady";
    EXPECT_NEAR(part_passed(0, 0, x), smooth_step(x), 1e-15) << "eased";
    EXPECT_NEAR(part_passed(0, 2, x), 2 * x * x * x * (1 - x / 2), 1e-15) << "eased in";
    // Rates whose mean is a little more than the way takes hardly differ from those that fit.
    EXPECT_NEAR(part_passed(0.5, 1.5 + 1e-6, x), part_passed(0.5, 1.5, x), 2e-6);
    EXPECT_NEAR(part_passed(0.5, 1.5 - 1e-6, x), part_passed(0.5, 1.5, x), 2e-6);
  }
}

// Between two fast ends the clock goes on at half the mean rate, and does not stand still.
TEST(RateLaws, KeepGoingBetweenFastEnds) {
  for (const double end : {3.0, 10.0, 400.0})
    for (int k = 0; k < 100; ++k) {
      const double rate =
          (part_passed(end, end, (k + 1) / 100.0) - part_passed(end, end, k / 100.0)) * 100;
      EXPECT_GT(rate, 0.499) << end << " at " << k;
      EXPECT_LT(rate, end + 1e-9) << end << " at " << k;
    }
}

TEST(RateLaws, AreRightNextToTheBeginningToAFewBitsOfThemselves) {
  EXPECT_NEAR(part_passed(5, 9, 1e-13) / 5e-13, 1, 1e-9);
  EXPECT_NEAR(part_passed(0.5, 0.25, 1e-13) / 0.5e-13, 1, 1e-9);
}

}  // namespace
}  // namespace domefall
