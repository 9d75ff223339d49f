#include "trajectories/double_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace domefall {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(DoubleDouble, ASumKeepsWhatRoundingTakes) {
  const DoubleDouble sum = exact_sum(1e13, 1e-10);
  EXPECT_EQ(sum.hi, 1e13);
  EXPECT_EQ(sum.lo, 1e-10);
  EXPECT_EQ(double(sum - 1e13), 1e-10);
  EXPECT_EQ(double(DoubleDouble(1e-10) + 1e13 - 1e13), 1e-10);
  EXPECT_EQ(double(1e13 - (DoubleDouble(1e13) - 3e-11)), 3e-11);
}

TEST(DoubleDouble, AProductKeepsWhatRoundingTakes) {
  const double x = 1 + 0x1p-40;
  const DoubleDouble square = exact_product(x, x);
  EXPECT_EQ(double(square - 1 - 0x1p-39), 0x1p-80);
}

TEST(DoubleDouble, ManyStepsAddUpToTheirSum) {
  DoubleDouble sum = 1e15;
  for (int k = 0; k < 1000; ++k) sum = sum + 0x1p-30;
  EXPECT_EQ(double(sum - 1e15), 1000 * 0x1p-30);
}

TEST(DoubleDouble, IsOrderedByItsValue) {
  const DoubleDouble one = 1, more = one + 0x1p-60, less = one - 0x1p-60;
  EXPECT_LT(less, one);
  EXPECT_LT(one, more);
  EXPECT_GT(more, less);
  EXPECT_NE(one, more);
  EXPECT_EQ(one, more - 0x1p-60);
  EXPECT_FALSE(DoubleDouble(std::nan("")) < one);
  EXPECT_FALSE(DoubleDouble(std::nan("")) >= one);
}

TEST(DoubleDouble, InfinityStaysInfinite) {
  const DoubleDouble endless = kInfinity;
  EXPECT_EQ(endless + 1, endless);
  EXPECT_EQ(1 - endless, -endless);
  EXPECT_EQ(exact_product(2, kInfinity), endless);
  EXPECT_LT(DoubleDouble(1e300), endless);
  EXPECT_TRUE(std::isnan(double(endless - endless)));
}

}  // namespace
}  // namespace domefall
