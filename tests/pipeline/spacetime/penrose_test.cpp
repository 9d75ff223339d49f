#include "pipeline/spacetime/penrose.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "pipeline/spacetime/schwarzschild.h"
#include "trajectories/kruskal_crossing.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

// The bound is a few roundings of numbers of size 1 and of logarithms of size 20.
constexpr double kRounding = 1e-14;

void expect_near(const PenrosePoint& a, const PenrosePoint& b, double tolerance = kRounding) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.up, b.up, tolerance);
}

double any_between(double least, double most) {
  return least + (most - least) * *rc::gen::inRange(0, 1'000'001) / 1e6;
}

TEST(Penrose, EachRegionIsInItsOwnPart) {
  for (const double t : {-30.0, -3.0, 0.0, 5.0, 40.0}) {
    for (const double r : {2.0001, 3.0, 8.0, 20.0}) {
      const PenrosePoint one = penrose_point(Region::kI, t, r);
      EXPECT_GT(one.x, std::abs(one.up));
      EXPECT_LT(one.x + std::abs(one.up), 1);
      const PenrosePoint three = penrose_point(Region::kIII, t, r);
      EXPECT_LT(three.x, -std::abs(three.up));
    }
    for (const double r : {1e-3, 0.5, 1.9999}) {
      const PenrosePoint two = penrose_point(Region::kII, t, r);
      EXPECT_GT(two.up, std::abs(two.x));
      EXPECT_LT(two.up, 0.5);
      const PenrosePoint four = penrose_point(Region::kIV, t, r);
      EXPECT_LT(four.up, -std::abs(four.x));
      EXPECT_GT(four.up, -0.5);
    }
  }
}

TEST(Penrose, TheHorizonsAreTheDiagonals) {
  for (const double null_time : {-20.0, -1.0, 0.0, 7.0, 30.0}) {
    const PenrosePoint future = penrose_point(Region::kII, Tetrad::kRain, 2, null_time);
    EXPECT_GT(future.x, 0);
    EXPECT_DOUBLE_EQ(future.x, future.up);
    const PenrosePoint past = penrose_point(Region::kIV, Tetrad::kOutgoing, 2, null_time);
    EXPECT_GT(past.x, 0);
    EXPECT_DOUBLE_EQ(past.x, -past.up);
  }
  // v = 0 means U = 1, which is the middle of the line.
  expect_near(penrose_point(Region::kII, Tetrad::kRain, 2, 0), {0.25, 0.25});
}

TEST(Penrose, TheSingularitiesAreStraightLines) {
  // Near the singularity U V - 1 is -r^2/8, and where U V = 1, arctan U + arctan V is pi/2.
  const double r = 1e-7;
  for (const double null_time : {-12.0, 0.0, 9.0}) {
    EXPECT_NEAR(penrose_point(Region::kII, Tetrad::kRain, r, null_time).up, 0.5, kRounding);
    EXPECT_NEAR(penrose_point(Region::kIV, Tetrad::kOutgoing, r, null_time).up, -0.5, kRounding);
  }
}

TEST(Penrose, InfinitiesAreCorners) {
  expect_near(penrose_point(Region::kI, 0, 1e9), {1, 0});
  expect_near(penrose_point(Region::kI, 1e12, 6), {0.5, 0.5});
  expect_near(penrose_point(Region::kI, -1e12, 6), {0.5, -0.5});
  expect_near(penrose_point(Region::kIII, -1e12, 6), {-0.5, 0.5});
  expect_near(penrose_point(Region::kI, Tetrad::kRain, 1e9, 4e12), {0.5, 0.5});
  // Light from the middle moves so that v grows and u stays.
  expect_near(penrose_point(Region::kI, Tetrad::kOutgoing, 1e9, 0), {0.75, 0.25});
  expect_near(penrose_point(Region::kI, Tetrad::kRain, 1e9, 0), {0.75, -0.25});
}

TEST(Penrose, IsMinkowskisAboutTheBifurcation) {
  // U + V is the proper time from U = V = 0 along t = 0 near r = 2, up to sqrt(32/e)/2.
  const double tau = 1e-4, r = 2 - tau * tau / 8;
  const PenrosePoint p = penrose_point(Region::kII, 0, r);
  EXPECT_NEAR(p.up, tau / 4 * std::exp(0.5) * 2 / std::acos(-1.0), 1e-9 * tau + 1e-12);
  EXPECT_EQ(p.x, 0);
}

RC_GTEST_PROP(Penrose, BothFramesNameTheSamePointOutside, ()) {
  const double r = 2 + std::exp(any_between(-15, 8)), t = any_between(-100, 100);
  const PenrosePoint p = penrose_point(Region::kI, t, r);
  expect_near(penrose_point(Region::kI, Tetrad::kRain, r, t + Schwarzschild::tortoise(r)), p,
              1e-12);
  expect_near(penrose_point(Region::kI, Tetrad::kOutgoing, r, t - Schwarzschild::tortoise(r)), p,
              1e-12);
}

RC_GTEST_PROP(Penrose, MirroredFramesAreReflections, ()) {
  const double r = std::exp(any_between(-5, 4)), null_time = any_between(-50, 50);
  const PenrosePoint p =
      penrose_point(r > 2 ? Region::kI : Region::kII, Tetrad::kRain, r, null_time);
  const PenrosePoint q =
      penrose_point(r > 2 ? Region::kIII : Region::kII, Tetrad::kRainOfThree, r, null_time);
  expect_near(q, {-p.x, p.up}, 0);
  const PenrosePoint o = penrose_point(Region::kIV, Tetrad::kOutgoing, r > 2 ? 2 : r, null_time);
  const PenrosePoint m =
      penrose_point(Region::kIV, Tetrad::kOutgoingToThree, r > 2 ? 2 : r, null_time);
  expect_near(m, {-o.x, o.up}, 0);
  // The mirrored frame's own time runs against t.
  if (r > 2)
    expect_near(q, penrose_point(Region::kIII, Schwarzschild::tortoise(r) - null_time, r), 1e-12);
}

TEST(Penrose, AFallIsContinuousAcrossTheHorizon) {
  const RadialInfall fall{4};
  const double crossing = double(proper_time_to(fall, 2));
  for (const double step : {1e-3, 1e-6, 1e-9}) {
    const OrbitPoint a = point_at(fall, crossing - step), b = point_at(fall, crossing + step);
    ASSERT_EQ(a.region, Region::kI);
    ASSERT_EQ(b.region, Region::kII);
    const PenrosePoint p = penrose_point(a.region, a.tetrad, a.r, double(a.null_time)),
                       q = penrose_point(b.region, b.tetrad, b.r, double(b.null_time));
    EXPECT_GT(q.up, p.up);
    EXPECT_LT(std::hypot(q.x - p.x, q.up - p.up), 2 * step);
  }
}

TEST(Penrose, AStaticObserverGoesFromThePastToTheFutureInfinityOnACurveSymmetricInTime) {
  const StaticObserver observer{6};
  const double middle = Schwarzschild::tortoise(6);  // v at t = 0
  for (const double tau : {0.5, 10.0, 60.0}) {
    const double v = double(point_at(observer, tau).null_time);
    const PenrosePoint after = penrose_point(Region::kI, Tetrad::kRain, 6, middle + v),
                       before = penrose_point(Region::kI, Tetrad::kRain, 6, middle - v);
    expect_near(after, {before.x, -before.up});
    EXPECT_GT(after.up, 0);
  }
  EXPECT_EQ(penrose_point(Region::kI, 0, 6).up, 0);
}

// x + up and up - x, which are arctan U and arctan V, never fall along a timelike path, so |dx| <
// dup.  Next to U = 0 and to the infinities rounding may swallow one of the two growths.
void expect_timelike(const Trajectory& trajectory, double tau_begin, double tau_end, double start) {
  constexpr int kSteps = 400;
  PenrosePoint before;
  for (int i = 0; i <= kSteps; ++i) {
    const OrbitPoint o = point_at(trajectory, tau_begin + (tau_end - tau_begin) * i / kSteps);
    const PenrosePoint p = penrose_point(o.region, o.tetrad, o.r, start + double(o.null_time));
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.up));
    if (i > 0) {
      const double dx = std::abs(p.x - before.x), up = p.up - before.up;
      ASSERT_LE(dx, up + 4e-16);
      const bool amid = p.x + p.up > 1e-3 && p.x + std::abs(p.up) < 1 - 1e-3;
      if (amid && up > 1e-6) {
        ASSERT_LT(dx, up);
      }
    }
    before = p;
  }
}

RC_GTEST_PROP(Penrose, EveryPathIsTimelike, ()) {
  const double r = std::exp(any_between(std::log(3.01), std::log(1000.0)));
  const double start = any_between(-60, 60), span = std::exp(any_between(-3, 8));
  expect_timelike(StaticObserver{r}, 0, span, start);
  expect_timelike(CircularOrbit{r}, 0, span, start);
  const RadialInfall fall{r};
  expect_timelike(fall, 0, double(proper_time_to(fall, 1e-3)), start);
}

// The path leads through IV, I and II.  Its frame is outgoing up to the largest r and rain from
// there on, with one t.
RC_GTEST_PROP(Penrose, APathThroughThreeRegionsIsTimelike, ()) {
  const double start = any_between(-40, 40);
  const Geodesic path = kruskal_crossing(any_between(0.05, 0.99), any_between(0, 3));
  expect_timelike(path, 0.9999 * path.birth(), 0.9999 * path.death(), start);
}

TEST(Penrose, APathThroughThreeRegionsIsContinuousWhereItsTetradChanges) {
  const Geodesic path = kruskal_crossing(0.3, 0.5);
  const OrbitPoint a = path.at(-1e-7), b = path.at(1e-7);
  ASSERT_EQ(a.tetrad, Tetrad::kOutgoing);
  ASSERT_EQ(b.tetrad, Tetrad::kRain);
  const PenrosePoint p = penrose_point(a.region, a.tetrad, a.r, double(a.null_time)),
                     q = penrose_point(b.region, b.tetrad, b.r, double(b.null_time));
  EXPECT_LT(std::hypot(q.x - p.x, q.up - p.up), 1e-7);
  EXPECT_GT(q.up, p.up);
}

}  // namespace
}  // namespace domefall
