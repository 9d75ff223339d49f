#include "pipeline/report/frame_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/report/frame_timing.h"
#include "pipeline/report/made_up_stars.h"

namespace domefall {
namespace {

GradedFrame even_frame(int size, std::uint16_t value) {
  GradedFrame frame(size, size);
  std::fill(frame.pixels.begin(), frame.pixels.end(), value);
  return frame;
}

TEST(FrameDifference, IsTheRootOfTheMeanSquareAndTheWorst) {
  const Projection flat = Stereographic{4, 4, 1};
  const GradedFrame black = even_frame(4, 0);
  GradedFrame one_white = black;
  one_white.row(2)[5] = 65535;
  const FrameDifference d = difference(one_white, black, flat);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(1.0 / 48));
  EXPECT_DOUBLE_EQ(d.worst, 1);
}

TEST(FrameDifference, LeavesOutWhatIsOutsideTheDome) {
  const GradedFrame black = even_frame(16, 0);
  GradedFrame corner = black;
  corner.row(0)[0] = 65535;
  EXPECT_EQ(difference(corner, black, Domemaster{16}).worst, 0);
  EXPECT_EQ(difference(corner, black, Stereographic{16, 16, 1}).worst, 1);
}

TEST(TimedFrames, AreThoseThatTheRendererMakes) {
  Show show;
  show.projection = Domemaster{64};
  show.sky[SkyRegion::kI].background = GridSky{};
  Segment segment;
  segment.duration_s = 1;
  segment.trajectory = StaticObserver{10};
  show.timeline = {segment};
  const TimedFrame timed = time_frame(show, {2, false}, 1, {3, 1});
  const HalfFrame frame = Renderer(show, 1, {2, false}).render(frame_state(show, 0));
  ASSERT_EQ(timed.frame.pixels.size(), frame.pixels.size());
  for (std::size_t k = 0; k < frame.pixels.size(); ++k)
    ASSERT_EQ(timed.frame.pixels[k].bits(), frame.pixels[k].bits());
  EXPECT_GT(timed.seconds, 0);
  EXPECT_TRUE(std::isfinite(timed.seconds));
  EXPECT_GT(copy_seconds(timed.frame), 0);
}

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
  EXPECT_TRUE(std::ranges::is_sorted(stars, {}, &CatalogueStar::v));
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
