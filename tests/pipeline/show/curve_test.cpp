#include "pipeline/show/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

namespace domefall {
namespace {

TEST(Curves, PassThroughTheirKeysAndStayBeyondThem) {
  const Curve c{{{1, 5}, {2, 7}, {4, -3}, {5, -3}}};
  for (const CurveKey& key : c.keys) EXPECT_DOUBLE_EQ(value_at(c, key.at_s), key.value);
  EXPECT_EQ(value_at(c, -10), 5);
  EXPECT_EQ(value_at(c, 10), -3);
  EXPECT_EQ(largest(c), 7);
}

TEST(Curves, HoldAndRunStraightWhereToldTo) {
  const Curve c{{{0, 1}, {2, 3, Ease::kLinear}, {4, 10, Ease::kHold}}};
  EXPECT_DOUBLE_EQ(value_at(c, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(value_at(c, 1.5), 2.5);
  EXPECT_EQ(value_at(c, 3.999), 3);
  EXPECT_EQ(value_at(c, 4), 10);
}

// The speed of a curve just before or just behind a keyframe.
double speed(const Curve& c, double t, double step) {
  return (value_at(c, t + step) - value_at(c, t)) / step;
}

TEST(Curves, StandStillAtTheEndsThatAreEased) {
  const auto of = [](Ease ease) { return Curve{{{0, 1}, {2, 5, ease}}}; };
  const double h = 1e-7, still = 1e-5, fast = 2 * (5 - 1) / 2.0;
  for (const auto& [ease, first, last] : {std::tuple{Ease::kEased, 0.0, 0.0},
                                          {Ease::kEasedIn, 0.0, fast},
                                          {Ease::kEasedOut, fast, 0.0}}) {
    EXPECT_NEAR(speed(of(ease), 0, h), first, still);
    EXPECT_NEAR(speed(of(ease), 2 - h, h), last, still);
    EXPECT_NEAR(value_at(of(ease), 2 - 1e-12), 5, 1e-9);
  }
  EXPECT_DOUBLE_EQ(value_at(of(Ease::kEased), 1), 3);
  // A smooth stretch takes over the speed of an eased one, and does not pass beyond its ends.
  const Curve joined{{{0, 0}, {1, 1, Ease::kEasedIn}, {3, 9}}};
  EXPECT_NEAR(speed(joined, 1, h), 2, still);
  EXPECT_NEAR(speed(joined, 1 - h, h), 2, still);
}

Curve random_curve(std::mt19937& engine) {
  std::uniform_real_distribution<double> any(-1, 1);
  Curve c;
  double t = any(engine);
  for (int k = 0; k < 6; ++k) {
    constexpr Ease kKinds[] = {Ease::kSmooth, Ease::kSmooth,  Ease::kLinear,
                               Ease::kEased,  Ease::kEasedIn, Ease::kEasedOut};
    const Ease ease = kKinds[engine() % std::size(kKinds)];
    c.keys.push_back({t, any(engine) < -0.5 ? 0.25 : any(engine), ease});
    t += std::exp(2 * any(engine));
  }
  return c;
}

// A curve has neither a flash nor a dip that no keyframe asks for.
TEST(Curves, NeverLeaveTheValuesOfTheKeysAround) {
  std::mt19937 engine(7);
  for (int n = 0; n < 500; ++n) {
    const Curve c = random_curve(engine);
    for (std::size_t k = 1; k < c.keys.size(); ++k) {
      const CurveKey &a = c.keys[k - 1], &b = c.keys[k];
      double before = a.value;
      for (int i = 1; i <= 50; ++i) {
        const double v = value_at(c, std::lerp(a.at_s, b.at_s, i / 50.0));
        EXPECT_GE((v - before) * (b.value - a.value), -1e-15) << "stretch " << k;
        before = v;
      }
    }
  }
}

TEST(Curves, HaveNoKinkWhereSmoothStretchesMeet) {
  std::mt19937 engine(8);
  for (int n = 0; n < 500; ++n) {
    const Curve c = random_curve(engine);
    for (std::size_t k = 1; k + 1 < c.keys.size(); ++k) {
      if (c.keys[k].ease != Ease::kSmooth || c.keys[k + 1].ease != Ease::kSmooth) continue;
      const double t = c.keys[k].at_s, h = 1e-7;
      const double in = (c.keys[k].value - value_at(c, t - h)) / h;
      const double out = (value_at(c, t + h) - c.keys[k].value) / h;
      EXPECT_NEAR(in, out, 1e-4);
    }
  }
}

TEST(Curves, BeginAndEndAtRest) {
  const Curve c{{{0, 1}, {10, 3}}};
  EXPECT_NEAR(value_at(c, 1e-3), 1, 1e-6);
  EXPECT_NEAR(value_at(c, 10 - 1e-3), 3, 1e-6);
  EXPECT_DOUBLE_EQ(value_at(c, 5), 2);
}

TEST(SmoothSteps, GoFromNoneToAllWithoutAJerk) {
  EXPECT_EQ(smooth_step(-1), 0);
  EXPECT_EQ(smooth_step(0), 0);
  EXPECT_DOUBLE_EQ(smooth_step(0.5), 0.5);
  EXPECT_EQ(smooth_step(1), 1);
  EXPECT_EQ(smooth_step(2), 1);
  EXPECT_LT(smooth_step(1e-3), 1e-8);  // third order
  EXPECT_GT(smooth_step(1 - 1e-3), 1 - 1.1e-8);
}

// ---- the rate of a clock ----

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
