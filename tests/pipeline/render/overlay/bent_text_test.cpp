#include "pipeline/render/overlay/bent_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// Each letter of a long line, not only its middle: a stroke points to the zenith.
TEST(TextSurface, PointsEveryLetterToTheZenithUpToSixtyDegrees) {
  const M33d level = audience_axes(Domemaster{64}, 0);
  for (const double elevation : {0., 20., 60.})
    for (const double x : {-12., 0., 25.}) {
      const TextSurface surface(level, 0.7, elevation * kDegree, 2 * kDegree);
      const V3d foot = surface.direction({x, -0.5}).v, head = surface.direction({x, 0.5}).v;
      // The plane of the stroke holds the zenith, and the whole line keeps its elevation.
      EXPECT_NEAR(foot.cross(head).normalized().z, 0, 1e-12) << elevation << " " << x;
      EXPECT_GT(head.z, foot.z);
      EXPECT_NEAR(surface.direction({x, 0}).v.z, std::sin(elevation * kDegree), 1e-12);
    }
  // At the zenith the line is a great circle.
  const TextSurface top(level, 0, 90 * kDegree, 2 * kDegree);
  for (const double x : {-20., 7.}) EXPECT_NEAR(top.direction({x, 0}).v.y, 0, 1e-12) << x;
}

TEST(TextSurface, KeepsTheFormOfLetters) {
  const TextSurface surface(audience_axes(Domemaster{64}, 0.2), 1, 0.8, 3 * kDegree);
  constexpr double kStep = 1e-5;
  for (const TextPoint at : {TextPoint{0, 0}, {10, 0.5}, {-9, -2}}) {
    const V3d here = surface.direction(at).v;
    const V3d right = surface.direction({at.x + kStep, at.y}).v - here,
              up = surface.direction({at.x, at.y + kStep}).v - here;
    EXPECT_NEAR(here.length(), 1, 1e-14);
    EXPECT_NEAR(right.dot(up) / (right.length() * up.length()), 0, 1e-4);
    EXPECT_NEAR(right.length() / up.length(), 1, 1e-4);
  }
  const V3d step = surface.direction({kStep, 0}).v - surface.direction({0, 0}).v;
  EXPECT_NEAR(step.length(), 3 * kDegree * kStep, 1e-10) << "a unit is the height";
}

TEST(TextSurface, FindsThePointOfADirection) {
  for (const double elevation : {0., 30., 75., 90.}) {
    const TextSurface surface(audience_axes(Domemaster{64}, 0.2), 1, elevation * kDegree,
                              3 * kDegree);
    for (const TextPoint p : {TextPoint{0, 0}, {10, 0.5}, {-9, -2}, {30, 4}}) {
      const TextPoint found = surface.point(surface.direction(p));
      EXPECT_NEAR(found.x, p.x, 1e-9) << elevation;
      EXPECT_NEAR(found.y, p.y, 1e-9) << elevation;
    }
  }
}

}  // namespace
}  // namespace domefall
