#include <gmock/gmock.h>

#include <numeric>

#include "pipeline/render/render_time.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {
namespace {

class LightCosts : public ShowFile {
 protected:
  // Two segments of ten frames.  In the first the sky races past an open shutter, so that its
  // frames are the mean of many instants; in the second nothing moves.
  Show two_segments() {
    return read(
        "size: 64\nframes_per_second: 10\nblack_hole: {mass_solar: 4e6}\n"
        "sky: {region_I: {background: grid, stars: none}}\nexposure: {shutter_deg: 180}\n"
        "timeline:\n"
        "  - {duration_s: 1, trajectory: {type: circular, r: 12, orbits: 3}}\n"
        "  - {duration_s: 1, trajectory: {type: static, r: 30}}\n");
  }
};

TEST_F(LightCosts, AreInUnitsOfTheirMeanAndChangeWithACut) {
  const Show show = two_segments();
  Renderer renderer(show, 1);
  std::vector<int> frames(20);
  std::iota(frames.begin(), frames.end(), 0);
  const std::vector<double> costs = relative_light_costs(show, frames, renderer);
  ASSERT_EQ(costs.size(), 20);
  EXPECT_NEAR(std::accumulate(costs.begin(), costs.end(), 0.0), 20, 1e-9);
  EXPECT_THAT(costs, testing::Each(testing::Gt(0)));
  // Nothing is interpolated over the cut.
  EXPECT_GT(costs[9], 4 * costs[10]);
}

TEST_F(LightCosts, OfFewFramesAreAsMany) {
  const Show show = two_segments();
  Renderer renderer(show, 1);
  EXPECT_THAT(relative_light_costs(show, {}, renderer), testing::IsEmpty());
  EXPECT_THAT(relative_light_costs(show, {7}, renderer),
              testing::ElementsAre(testing::DoubleNear(1, 1e-12)));
  EXPECT_THAT(relative_light_costs(show, {7, 15}, renderer), testing::SizeIs(2));
}

}  // namespace
}  // namespace domefall
