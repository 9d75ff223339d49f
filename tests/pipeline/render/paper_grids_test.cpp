// The captions of those figures of [Riazuelo] that have no orbit in them, held against the shows of
// shows/paper/.  Tolerances are half of a caption's last digit where no other reason is given.
#include "pipeline/sources/sky/formula_sky.h"
#include "tests/pipeline/render/paper_figures.h"

namespace domefall {
namespace {

TEST(PaperFigAberr1, TheEdgesAreAsManyDegreesOfSkyApartAsTheCaptionSays) {
  const Show show = figure("fig_aberr1");
  ASSERT_EQ(frame_count(show), 4);
  const double captioned[] = {90, 117.8, 158.6, 244.1};
  for (int k = 0; k < 4; ++k) {
    const Panel panel(show, k);
    // The angle is summed on both sides of the middle, since the last is more than half a circle.
    const V3d left = panel.trace(0, 0.5).sky_direction,
              middle = panel.trace(0.5, 0.5).sky_direction,
              right = panel.trace(1, 0.5).sky_direction;
    EXPECT_NEAR((angle_between(left, middle) + angle_between(middle, right)) / kOneDegree,
                captioned[k], 0.05);
  }
}

TEST(PaperFigAberr1, ThePolesEndUp517DegreesApartInThePicture) {
  const Panel panel(figure("fig_aberr1"), 3);
  const V3d north = panel.image({0, 0, 1}, 0), south = panel.image({0, 0, -1}, 0);
  EXPECT_NEAR(angle_between(north, south) / kOneDegree, 51.7, 0.05);
  EXPECT_TRUE(panel.shows(north) && panel.shows(south));
  EXPECT_LT(north.y, 0);
  // A view ray through the image comes from the pole.
  EXPECT_LT((panel.tracer.trace({north}).sky_direction - V3d(0, 0, 1)).length(), 1e-12);
}

// Positions lie in the middles of the grid's squares.  A quarter turn is 18 of them, a half 36.
TEST(PaperFigAberr2, WithoutTheMotionTheThreeViewsWouldBeTheStaticOne) {
  Show show = figure("fig_aberr2");
  ASSERT_EQ(frame_count(show), 4);
  const Panel still(show, 3);
  show.effects.aberration = false;
  for (int k = 0; k < 3; ++k) {
    const Panel panel(show, k);
    EXPECT_NEAR(panel.state.observer.celerity.length(), 0.5 / std::sqrt(0.75), 1e-15);
    for (double x = 0.05; x < 1; x += 0.1)
      for (double y = 0.05; y < 1; y += 0.1) {
        const V3d a = panel.trace(x, y).sky_direction, b = still.trace(x, y).sky_direction;
        EXPECT_NEAR(a.z, b.z, 1e-14);
        const double turn = std::atan2(b.y, b.x) - std::atan2(a.y, a.x) - k * std::numbers::pi / 2;
        EXPECT_NEAR(std::sin(turn / 2), 0, 1e-14) << "frame " << k;
      }
  }
}

TEST(PaperFigDop, OnlyTheColourIsAddedToFigAberr2AndTheIntensityInFigInt) {
  const Effects aberration = figure("fig_aberr2").effects, colour = figure("fig_dop").effects,
                everything = figure("fig_int").effects;
  EXPECT_EQ(aberration, (Effects{.doppler_colour = false, .intensity = false}));
  EXPECT_EQ(colour, (Effects{.intensity = false}));
  EXPECT_EQ(everything, Effects{});
}

TEST(PaperFigInt, TheBolometricFactorIsNineAheadAndAsMuchLessBehind) {
  const Show show = figure("fig_int");
  const auto factor = [&](int k) { return std::pow(1 + Panel(show, k).z(0.5, 0.5), -4); };
  EXPECT_NEAR(factor(0), 9, 1e-12);
  EXPECT_NEAR(factor(1), std::pow(0.75, 2), 1e-12);  // 1/gamma to the side
  EXPECT_NEAR(factor(2), 1 / 9., 1e-13);
  EXPECT_NEAR(factor(3), 1, 1e-15);
}

// ---- at rest near the hole ----

TEST(PaperFigDev2, TheSquareInFrontIsDarkAndTheShiftIsMinus339TenThousandths) {
  const Show show = figure("fig_dev2");
  ASSERT_EQ(frame_count(show), 2);
  const Panel without(show, 0), with(show, 1);
  // The ray passes beside the hole, which is a point where light goes straight.
  const V3d centre = without.trace(0.501, 0.5).sky_direction;
  EXPECT_NEAR(std::asin(centre.z) / kOneDegree, -32.4, 1e-3);
  const auto light = [&](double x) {
    return grid_light({without.trace(x, 0.5).sky_direction}, 1e-4).squares;
  };
  EXPECT_NEAR(light(0.501) / light(0.5 + 5.5 / 90), 0.25, 1e-3);  // its neighbour
  EXPECT_NEAR(without.z(0.2, 0.3), 0, 2e-9);                      // 1/r
  EXPECT_NEAR(with.z(0.2, 0.3), -0.0339, 5e-5);
  EXPECT_EQ(with.state.observer.r, 30);
  EXPECT_EQ(with.trace(0.5, 0.5).sky, SkyRegion::kIV);
}

// The radius of the Einstein ring in radians: the angle between the hole and the image of a star
// that stands behind it just beside the axis.
double einstein_ring(const Panel& panel, const Show& show) {
  const V3d behind = (show.hole_at.v + V3d(1e-7, 0, 0)).normalized();
  return angle_between(panel.image(behind, 0), panel.hole());
}

TEST(PaperFigDev2, TheSouthPolesGhostIsAboveAndTheNorthPolesBelow) {
  const Panel panel(figure("fig_dev2"), 1);
  const V3d hole = panel.hole();
  const double ring = einstein_ring(panel, figure("fig_dev2"));
  for (const double pole : {-1., 1.}) {
    const V3d ghost = panel.image({0, 0, pole}, 1);
    EXPECT_NEAR(ghost.x, 0, 1e-9);
    EXPECT_GT(ghost.y * pole, 0);  // Y points down
    EXPECT_TRUE(panel.shows(ghost));
    EXPECT_LT(angle_between(ghost, hole), ring);
  }
}

// The position down from the panel's top at which the silhouette begins in this column.
double horizon_line(const Panel& panel, double x) {
  double above = 0, below = 1;
  for (int k = 0; k < 50; ++k) {
    const double y = (above + below) / 2;
    (panel.trace(x, y).sky == SkyRegion::kIV ? below : above) = y;
  }
  return above;
}

TEST(PaperFigBlue, TheShiftsAreThoseOfTheCaptionAndTheSilhouetteTurnsFromConvexToHollow) {
  const Show show = figure("fig_blue");
  ASSERT_EQ(frame_count(show), 3);
  const double radius[] = {4, 3, 2.5}, z[] = {-0.293, -0.423, -0.553};
  for (int k = 0; k < 3; ++k) {
    const Panel panel(show, k);
    EXPECT_EQ(panel.state.observer.r, radius[k]);
    EXPECT_NEAR(panel.z(0.5, 0.05), z[k], 5e-4);
    // A convex silhouette begins lower at the sides.  At r = 3 its edge is straight.
    const double sag = horizon_line(panel, 0.1) - horizon_line(panel, 0.5);
    if (k == 0) {
      EXPECT_GT(sag, 0.02);
    }
    if (k == 1) {
      EXPECT_NEAR(sag, 0, 1e-12);
    }
    if (k == 1) {
      EXPECT_NEAR(horizon_line(panel, 0.5), 0.5, 1e-12);
    }
    if (k == 2) {
      EXPECT_LT(sag, -0.02);
    }
  }
  EXPECT_EQ(Panel(show, 2).trace(0.5, 0.05).sky, SkyRegion::kIII);
  EXPECT_TRUE(std::holds_alternative<GridSky>(show.sky[SkyRegion::kIII].background));
  EXPECT_FALSE(show.sky[SkyRegion::kIII].stars);
}

TEST(PaperFigDev3, OneBrightRingAroundTheSilhouetteAndAThinOneAtItsEdge) {
  const Show show = figure("fig_dev3");
  ASSERT_EQ(frame_count(show), 2);
  EXPECT_EQ(show.effects.amplification, Amplification::kEverything);
  const Panel far(show, 0), near(show, 1);
  const V3d hole = near.hole();
  // at(beyond) is the direction up left of the hole, `beyond` radians outside the silhouette's
  // edge.
  const double edge = std::asin(3 * std::sqrt(3) / 30 * std::sqrt(1 - 2 / 30.));
  const V3d aside = (V3d(0, 0, 1) - hole * hole.z).normalized();
  const auto at = [&](double beyond) {
    return hole * std::cos(edge + beyond) + aside * std::sin(edge + beyond);
  };
  const auto magnified = [&](double beyond) {
    const ViewRay ray = near.tracer.trace({at(beyond)});
    return 1 / (ray.scale_along * ray.scale_across);
  };
  double largest = 0, ring = 0;
  for (double beyond = 1e-4; beyond < 0.02; beyond += 1e-5)
    if (magnified(beyond) > largest) largest = magnified(ring = beyond);
  EXPECT_GT(largest, 1);
  EXPECT_LT(ring, 0.5 * kOneDegree);
  EXPECT_TRUE(near.shows(at(ring)));
  // The panel shows what is up left of the hole, and is upright.
  EXPECT_GT(hole.x, 0);
  EXPECT_GT(hole.y, 0);
  EXPECT_LT(near.in_camera({0, -1, 0}).y, -0.9);
  EXPECT_LT(magnified(3 * kOneDegree), 0.2);
  const double einstein = einstein_ring(far, show) - edge;
  EXPECT_GT(magnified(einstein - kOneDegree), 2);
  EXPECT_GT(magnified(einstein + kOneDegree), 2);
  // Farther from the hole the light is slightly fainter than without it.
  const ViewRay corner = far.trace(0, 0);
  EXPECT_LT(1 / (corner.scale_along * corner.scale_across), 1);
  EXPECT_GT(1 / (corner.scale_along * corner.scale_across), 0.9);
}

}  // namespace
}  // namespace domefall
