#include "pipeline/sky/catalogue/star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/sky/catalogue/read_star_catalogue.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

double light(const std::vector<Star>& stars, bool north_only) {
  double sum = 0;
  for (const Star& s : stars)
    if (!north_only || s.direction.v.z > 0) sum += std::pow(10, -0.4 * double{s.v_magnitude});
  return sum;
}

TEST(ThinnedStars, SendTheSameLightSortedByMagnitude) {
  const auto stars = read_star_catalogue(source_file("shows/assets/stars_to_9.stars"), 9).stars;
  const auto few = thinned(stars, 512);
  EXPECT_LT(few.size(), 512 * 6);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end(), [](const Star& a, const Star& b) {
    return a.v_magnitude < b.v_magnitude;
  }));
  EXPECT_NEAR(light(few, false) / light(stars, false), 1, 1e-3);
  // Of half of the sky, it is theirs to what so few can be: 2500 of nearly one brightness.
  EXPECT_NEAR(light(few, true) / light(stars, true), 1, 0.02);
}

TEST(ThinnedStars, AreAllOfThemWhereThereAreFew) {
  std::vector<Star> stars(5, Star{{V3d(1, 0, 0)}, 3, 6000});
  EXPECT_EQ(thinned(stars, 5).size(), 5u);
  EXPECT_EQ(thinned(stars, 9).size(), 5u);
  EXPECT_TRUE(thinned({}, 5).empty());
}

}  // namespace
}  // namespace domefall
