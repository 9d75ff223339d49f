#include "pipeline/render/stage_times.h"

#include <gmock/gmock.h>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Has no two numbers that are the same, and larger ones in some fields than other_times().
StageTimes some_times() {
  StageTimes times;
  times.load_s = 1, times.tables_s = 2, times.stars_s = 3;
  times.grid_s = 4, times.disc_s = 5, times.pixels_s = 6;
  times.traced_fraction = 0.25;
  times.table_nodes = 700, times.images = 80;
  times.tables_made = 9;
  times.black[SkyRegion::kI] = 0.5, times.black[SkyRegion::kIII] = 0.125;
  return times;
}

StageTimes other_times() {
  StageTimes times;
  times.load_s = 10, times.tables_s = 20, times.stars_s = 30;
  times.grid_s = 40, times.disc_s = 50, times.pixels_s = 60;
  times.traced_fraction = 0.75;
  times.table_nodes = 300, times.images = 4;
  times.tables_made = 1;
  times.black[SkyRegion::kI] = 0.25, times.black[SkyRegion::kIV] = 1;
  return times;
}

FramePlan inside_plan() {
  FramePlan plan;
  plan.gravity = true;
  plan.sky[SkyRegion::kI].background = plan.sky[SkyRegion::kI].stars = true;
  plan.sky[SkyRegion::kIII].stars = true;
  return plan;
}

TEST(StageTimes, OfInstantsAreSumsAndTheRestIsTheLarger) {
  for (const bool swapped : {false, true}) {
    StageTimes sum = swapped ? other_times() : some_times();
    sum.instants = 7;
    sum.add(swapped ? some_times() : other_times());
    EXPECT_EQ(sum.load_s, 11);
    EXPECT_EQ(sum.tables_s, 22);
    EXPECT_EQ(sum.stars_s, 33);
    EXPECT_EQ(sum.grid_s, 44);
    EXPECT_EQ(sum.disc_s, 55);
    EXPECT_EQ(sum.pixels_s, 66);
    EXPECT_EQ(sum.images, 84U);
    EXPECT_EQ(sum.tables_made, 10);
    EXPECT_EQ(sum.traced_fraction, 0.75);
    EXPECT_EQ(sum.table_nodes, 700U);
    EXPECT_EQ(sum.black[SkyRegion::kI], 0.5);
    EXPECT_EQ(sum.black[SkyRegion::kIII], 0.125);
    EXPECT_EQ(sum.black[SkyRegion::kIV], 1);
    // Whoever adds them up counts them.
    EXPECT_EQ(sum.instants, 7);
  }
}

TEST(StageTimes, AreDescribedByALineForEachStage) {
  EXPECT_EQ(describe(inside_plan(), some_times()),
            "load       1.000 s  sky I: background, stars; sky III: no background, stars; "
            "sky IV: no background, no stars\n"
            "black   0.5 cd/m^2 of the map of sky I\n"
            "black   0.125 cd/m^2 of the map of sky III\n"
            "tables   2.00000 s  sky I and sky III, 700 nodes, 9 made\n"
            "stars     3.0000 s  80 images\n"
            "grid      4.0000 s\n"
            "pixels    6.0000 s  25.0 % traced one by one; loops: " +
                std::string(name_of(simd_in_use())) + "\n");
}

TEST(StageTimes, TellOfADiscAndOfAShutterOnlyWhereThereIsOne) {
  FramePlan plan = inside_plan();
  StageTimes times = some_times();
  EXPECT_THAT(describe(plan, times), Not(HasSubstr("disc")));
  EXPECT_THAT(describe(plan, times), Not(HasSubstr("shutter")));
  plan.disc = true;
  times.instants = 16;
  EXPECT_THAT(describe(plan, times), HasSubstr("\ndisc      5.0000 s  drawn with the pixels\n"));
  EXPECT_THAT(describe(plan, times), HasSubstr("\nshutter open: the mean of 16 instants\n"));
}

TEST(StageTimes, SayWhyThereAreNoTables) {
  FramePlan plan = inside_plan();
  plan.gravity = false;
  EXPECT_THAT(describe(plan, {}), HasSubstr(" s  straight light: none, 0 nodes, 0 made\n"));
  plan = {};
  plan.gravity = true;
  EXPECT_THAT(describe(plan, {}), HasSubstr(" s  all skies black: none, 0 nodes, 0 made\n"));
}

}  // namespace
}  // namespace domefall
