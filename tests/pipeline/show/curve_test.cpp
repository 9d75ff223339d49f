#include "pipeline/show/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

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

Curve random_curve(std::mt19937& engine) {
  std::uniform_real_distribution<double> any(-1, 1);
  Curve c;
  double t = any(engine);
  for (int k = 0; k < 6; ++k) {
    const Ease ease = any(engine) < 0.6 ? Ease::kSmooth : Ease::kLinear;
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

}  // namespace
}  // namespace domefall
