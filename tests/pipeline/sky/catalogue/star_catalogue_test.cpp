#include "pipeline/sky/catalogue/star_catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

// A table and a .stars file are thinned out in the same way.
TEST(ThinnedStars, SendTheSameLightSortedByMagnitude) {
  for (const char* name : {"stars_to_9.stars", "stars_to_8.csv"}) {
    const std::string file = source_file("shows/assets/") + name;
    const StarCatalogue all = read_star_catalogue(file, 9),
                        few = read_star_catalogue(file, 9, kCatalogueEpoch, 512);
    EXPECT_LT(few.stars.size(), 512 * 6) << name;
    EXPECT_TRUE(std::ranges::is_sorted(few.stars, {}, &Star::v_magnitude)) << name;
    EXPECT_EQ(few.names.size(), all.names.size()) << name;
    EXPECT_EQ(few.names.back().direction.v, all.names.back().direction.v) << name;
    EXPECT_NEAR(light(few.stars, false) / light(all.stars, false), 1, 1e-3) << name;
    // Of half of the sky, it is theirs to what so few can be: 2500 of nearly one brightness.
    EXPECT_NEAR(light(few.stars, true) / light(all.stars, true), 1, 0.02) << name;
  }
}

using Kept = std::vector<std::pair<std::size_t, std::size_t>>;

Kept kept(std::size_t stars, std::size_t whole) {
  Kept found;
  thin_out(stars, whole, [&](std::size_t k, std::size_t count) { found.push_back({k, count}); });
  return found;
}

TEST(ThinnedStars, StandForTheMoreTheFainterTheyAre) {
  EXPECT_EQ(kept(8, 2), (Kept{{0, 1}, {1, 1}, {3, 2}, {6, 4}}));
  EXPECT_EQ(kept(3, 3), (Kept{{0, 1}, {1, 1}, {2, 1}}));
  EXPECT_EQ(kept(2, kAllWhole), (Kept{{0, 1}, {1, 1}}));
  EXPECT_TRUE(kept(0, 5).empty());
}

}  // namespace
}  // namespace domefall
