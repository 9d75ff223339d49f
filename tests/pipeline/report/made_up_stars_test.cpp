#include "pipeline/report/made_up_stars.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace domefall {
namespace {

TEST(MadeUpStars, AreAsManyByMagnitudeAsTycho2Has) {
  const RawCatalogue catalogue = made_up_stars(200'000);
  const auto brighter = [&](float v) {
    return std::count_if(catalogue.stars.begin(), catalogue.stars.end(),
                         [v](const CatalogueStar& star) { return star.v <= v; });
  };
  EXPECT_NEAR(static_cast<double>(brighter(6.5F)), 8805, 1);
  EXPECT_NEAR(static_cast<double>(brighter(9)), 130720, 1);
  EXPECT_DOUBLE_EQ(magnitude_of_rank(1), -1.5);
  EXPECT_DOUBLE_EQ(magnitude_of_rank(kMostMadeUpStars), 13);
}

TEST(MadeUpStars, ComeBrightestFirstAndEvenlySpread) {
  const std::vector<CatalogueStar> stars = made_up_stars(100'000).stars;
  EXPECT_TRUE(
      std::is_sorted(stars.begin(), stars.end(),
                     [](const CatalogueStar& a, const CatalogueStar& b) { return a.v < b.v; }));
  V3d sum(0, 0, 0), squares(0, 0, 0);
  for (const CatalogueStar& star : stars) {
    const V3d& d = star.direction.v;
    EXPECT_NEAR(d.length2(), 1, 1e-14);
    sum += d, squares += d * d;
  }
  // The mean of each component is 0 and the mean of its square 1/3.  Four standard deviations of
  // these means are 0.0073 and 0.0038 for 100,000 stars.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sum[axis] / 1e5, 0, 0.0073);
    EXPECT_NEAR(squares[axis] / 1e5, 1.0 / 3, 0.0038);
  }
}

TEST(MadeUpStars, OfASmallSkyAreTheFirstOnesOfALargeSky) {
  const RawCatalogue few = made_up_stars(10), many = made_up_stars(20);
  for (std::size_t k = 0; k < few.stars.size(); ++k) {
    EXPECT_EQ(few.stars[k].direction.v, many.stars[k].direction.v);
    EXPECT_EQ(few.stars[k].colour, many.stars[k].colour);
  }
}

}  // namespace
}  // namespace domefall
