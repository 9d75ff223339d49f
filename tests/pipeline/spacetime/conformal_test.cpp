#include "pipeline/spacetime/conformal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace domefall {
namespace {

using enum Region;

void expect_at(const PenrosePoint& a, const PenrosePoint& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.up, b.up, tolerance);
}

TEST(ChargedDiagram, WithoutChargeItIsSchwarzschilds) {
  const ChargedHole none(1, 0);
  for (const double v : {-20.0, -1.0, 0.0, 7.0}) {
    for (const double r : {0.3, 1.0, 1.999, 2.001, 5.0, 30.0}) {
      const Region in = r > 2 ? kI : kII, out = r > 2 ? kI : kIV;
      expect_at(penrose_point(none, in, 0, Tetrad::kRain, r, v),
                penrose_point(in, Tetrad::kRain, r, v), 1e-13);
      expect_at(penrose_point(none, out, 0, Tetrad::kOutgoing, r, v),
                penrose_point(out, Tetrad::kOutgoing, r, v), 1e-13);
    }
    expect_at(penrose_point(none, kIII, 0, Tetrad::kRainOfThree, 3, v),
              penrose_point(kIII, Tetrad::kRainOfThree, 3, v), 1e-13);
  }
}

// Beside a horizon, on both sides of it and on it, is one point.
TEST(ChargedDiagram, RegionsMeetAtTheirHorizons) {
  const ChargedHole hole(1, 0.9L);
  const double outer = hole.horizon(), inner = hole.inner_horizon();
  for (const double time : {-9.0, -0.5, 0.0, 3.0}) {
    const auto in = [&](Region region, double r) {
      return penrose_point(hole, region, 0, Tetrad::kRain, r, time);
    };
    const auto out = [&](Region region, int universe, double r) {
      return penrose_point(hole, region, universe, Tetrad::kOutgoing, r, time);
    };
    expect_at(in(kI, outer * (1 + 1e-9)), in(kII, outer * (1 - 1e-9)), 1e-6);
    expect_at(in(kI, outer), in(kII, outer), 1e-12);
    EXPECT_NEAR(in(kI, outer).up, in(kI, outer).x, 1e-12) << "the line from the middle";
    // Here h has another rate than the horizon, so that the two sides come together slowly.
    expect_at(in(kII, inner * (1 + 1e-15)), in(kV, inner * (1 - 1e-15)), 0.03);
    expect_at(out(kV, 0, inner * (1 - 1e-15)), out(kIV, 1, inner * (1 + 1e-15)), 0.03);
    expect_at(out(kIV, 1, outer), out(kI, 1, outer), 1e-12);
  }
}

// In all kinds a line of constant v runs up to the left, one of constant u up to the right.
TEST(ChargedDiagram, LightRunsAtFortyFiveDegrees) {
  const ChargedHole hole(1, 0.8L);
  for (const double r : {0.1, 0.3, 0.7, 1.2, 2.0, 9.0}) {
    const Region in = r > hole.horizon() ? kI : r > hole.inner_horizon() ? kII : kV;
    const PenrosePoint a = penrose_point(hole, in, 0, Tetrad::kRain, r, 0.4),
                       b = penrose_point(hole, kI, 0, Tetrad::kRain, 4, 0.4);
    EXPECT_NEAR(a.x + a.up, b.x + b.up, 1e-12) << r;
    const Region out = r > hole.horizon() ? kI : r > hole.inner_horizon() ? kIV : kV;
    const PenrosePoint c = penrose_point(hole, out, out == kV ? 0 : 1, Tetrad::kOutgoing, r, -0.4),
                       d = penrose_point(hole, kI, 1, Tetrad::kOutgoing, 4, -0.4);
    EXPECT_NEAR(c.up - c.x, d.up - d.x, 1e-12) << r;
  }
}

TEST(ChargedDiagram, SingularitiesAreVertical) {
  for (const long double q : {0.3L, 0.9L, 1.0L, 1.2L}) {
    const ChargedHole hole(1, q);
    const Region inside = hole.is_naked() ? kI : kV;
    const double x = penrose_point(hole, inside, 0, 0, 1e-12).x;
    EXPECT_NEAR(x, q < 1 ? -0.5 : 0, 1e-9);
    for (const double t : {-40.0, -3.0, 0.2, 11.0})
      EXPECT_NEAR(penrose_point(hole, inside, 0, t, 1e-12).x, x, 1e-9);
  }
}

TEST(ChargedDiagram, UniversesStandAboveEachOther) {
  for (const long double q : {0.9L, 1.0L}) {
    const ChargedHole hole(1, q);
    const PenrosePoint zero = penrose_point(hole, kI, 0, Tetrad::kRain, 7, 1.5),
                       two = penrose_point(hole, kI, 2, Tetrad::kRain, 7, 1.5);
    expect_at(two, {zero.x, zero.up + 2 * universe_height(hole)}, 1e-14);
    // The outgoing tetrad gives the same point at the same t.
    const double u = 1.5 - 2 * hole.tortoise(7);
    expect_at(zero, penrose_point(hole, kI, 0, Tetrad::kOutgoing, 7, u), 1e-14);
  }
}

TEST(ChargedDiagram, TheMirrorImageIsMirrored) {
  const ChargedHole hole(1, 0.9L);
  const PenrosePoint five = penrose_point(hole, kV, 0, Tetrad::kRain, 0.3, 0.2),
                     six = penrose_point(hole, kVI, 0, Tetrad::kRainOfThree, 0.3, 0.2);
  expect_at(six, {-five.x, five.up}, 0);
}

TEST(WormholeDiagram, IsOneDiamondWithTheThroatInTheMiddle) {
  const Wormhole wormhole;
  EXPECT_EQ(penrose_point(wormhole, 3, 0).x, 0);
  const PenrosePoint right = penrose_point(wormhole, 1, 5), left = penrose_point(wormhole, 1, -5);
  expect_at(left, {-right.x, right.up}, 1e-15);
  EXPECT_GT(penrose_point(wormhole, 0, 1e9).x, 1 - 1e-8);
  EXPECT_GT(penrose_point(wormhole, 1e9, 0).up, 1 - 1e-8);
}

}  // namespace
}  // namespace domefall
