#include "pipeline/report/frame_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace domefall {
namespace {

const FrameCosts& quick_costs() {
  static const FrameCosts costs = measure_frame_costs(true);
  return costs;
}

std::vector<FrameCostRow> cost_rows(const std::vector<double>& stars,
                                    const std::vector<double>& ms) {
  std::vector<FrameCostRow> made;
  for (std::size_t k = 0; k < stars.size(); ++k)
    made.push_back({"a sky", 1, 1, stars[k], 1e-3 * ms[k], 1});
  return made;
}

TEST(CostSlopes, AreBetweenNeighbouringRowsOfAScene) {
  std::vector<FrameCostRow> both = cost_rows({1000, 2000, 4000}, {1, 2, 6});
  for (FrameCostRow row : cost_rows({10, 20}, {5, 6})) row.scene = "another", both.push_back(row);
  const std::vector<CostSlope> found = slopes(both, &FrameCostRow::stars);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].ns, 1e3, 1e-9);
  EXPECT_NEAR(found[1].ns, 2e3, 1e-9);
  EXPECT_NEAR(found[2].ns, 1e5, 1e-6);
  EXPECT_EQ(found[1].from, 2000);
  EXPECT_EQ(found[2].scene, "another");
  EXPECT_NEAR(mean_slope(both, &FrameCostRow::stars, "a sky"), 5e6 / 3000, 1e-9);
  EXPECT_NEAR(mean_slope(both, &FrameCostRow::stars, "another"), 1e5, 1e-6);
}

// A rise is measured within a scene, never from one scene to the next.
TEST(CostSlopes, RiseMostAtACliff) {
  std::vector<FrameCostRow> both = cost_rows({1, 2, 3, 4, 5}, {1, 2, 3, 13, 14});
  for (FrameCostRow row : cost_rows({1, 2}, {1, 1000})) row.scene = "another", both.push_back(row);
  const auto rise = steepest_rise(slopes(both, &FrameCostRow::stars));
  ASSERT_TRUE(rise);
  EXPECT_NEAR(rise->ratio, 10, 1e-9);
  EXPECT_EQ(rise->at, 3);
  EXPECT_EQ(rise->scene, "a sky");
}

TEST(CostSlopes, ThatAreNotPositiveHaveNoRatio) {
  EXPECT_FALSE(steepest_rise(slopes(cost_rows({1, 2, 3}, {1, 1, 2}), &FrameCostRow::stars)));
  EXPECT_FALSE(steepest_rise(slopes(cost_rows({1, 2}, {1, 2}), &FrameCostRow::stars)));
}

TEST(FrameCosts, AscendInOneThingAlone) {
  ASSERT_EQ(quick_costs().stars.size(), 6u);
  ASSERT_EQ(quick_costs().pixels.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    const FrameCostRow &stars = quick_costs().stars[k], &pixels = quick_costs().pixels[k];
    EXPECT_EQ(stars.size, quick_costs().stars[0].size);
    EXPECT_NEAR(pixels.pixels, std::numbers::pi / 4 * std::pow(pixels.size, 2), 4.0 * pixels.size);
    EXPECT_EQ(pixels.stars, k < 3 ? 0 : 1000);
    if (k % 3 == 0) continue;
    EXPECT_GT(stars.stars, quick_costs().stars[k - 1].stars);
    EXPECT_GT(pixels.pixels, quick_costs().pixels[k - 1].pixels);
  }
  EXPECT_EQ(quick_costs().stars[2].stars, 10'000);
}

TEST(FrameCosts, AreFiniteTimesAndCopies) {
  for (const auto* series : {&quick_costs().stars, &quick_costs().pixels})
    for (const FrameCostRow& row : *series) {
      EXPECT_GT(row.seconds, 0) << row.scene;
      EXPECT_GT(row.copies, 0) << row.scene;
      EXPECT_TRUE(std::isfinite(row.copies)) << row.scene;
    }
}

TEST(FrameCosts, OfThePapersPictureComeWithItsErrors) {
  ASSERT_EQ(quick_costs().benchmark.size(), 3u);
  const FrameErrorRow &usual = quick_costs().benchmark[0], &twice = quick_costs().benchmark[1],
                      &four_times = quick_costs().benchmark[2];
  EXPECT_LT(four_times.rms, twice.rms);
  EXPECT_LT(usual.rms, twice.rms);
  EXPECT_GT(four_times.rms, 0);
  EXPECT_GT(usual.seconds, 0);
}

}  // namespace
}  // namespace domefall
