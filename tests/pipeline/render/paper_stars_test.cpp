// The captions of [Riazuelo] on stars and their ghosts, held against the shows of shows/paper/.
#include "pipeline/light/schwarzschild_zone.h"
#include "pipeline/light/silhouette.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/pipeline/render/paper_figures.h"

namespace domefall {
namespace {

constexpr double kMilliarcsecond = kOneDegree / 3.6e6;

double edge_from_rest(double r) { return std::asin(3 * std::sqrt(3) / r * std::sqrt(1 - 2 / r)); }

// The side of the middle on which a star is: +1 right or below, -1 left or above, 0 for any.
struct StarInPanel {
  const char* star;
  int x, y;
};

void expect_quadrants(const Panel& panel, std::initializer_list<StarInPanel> places) {
  for (const StarInPanel& p : places) {
    const V3d n = panel.image(star(p.star), 0);
    EXPECT_TRUE(panel.shows(n)) << p.star << n;
    if (p.x) {
      EXPECT_GT(n.x * p.x, 0) << p.star << n;
    }
    if (p.y) {
      EXPECT_GT(n.y * p.y, 0) << p.star << n;
    }
  }
}

TEST(PaperMult, TheCaptionsStarsAreWhereItSaysAndDouble) {
  const Panel panel(figure("mult"), 0);
  expect_quadrants(panel, {{"Rigil Kentaurus", -1, -1},
                           {"beta Cen", -1, -1},
                           {"gamma Cru", -1, -1},
                           {"Canopus", 1, 0}});
  const V3d hole = panel.hole();
  const double ring = angle_between(panel.image(star("HD 49359"), 0), hole);
  for (const char* name : {"Rigil Kentaurus", "beta Cen", "gamma Cru", "Canopus", "Sirius"}) {
    const V3d outside = panel.image(star(name), 0), inside = panel.image(star(name), 1);
    EXPECT_GT(angle_between(outside, hole), ring) << name;
    EXPECT_LT(angle_between(inside, hole), ring) << name;
    EXPECT_TRUE(panel.shows(inside)) << name;
  }
  EXPECT_FALSE(panel.shows(panel.image(star("Sirius"), 0)));
  EXPECT_GT(panel.image(star("Sirius"), 0).x, 0);  // beyond the right edge
  const V3d small_cloud(std::cos(-72.8 * kOneDegree) * std::cos(13.2 * kOneDegree),
                        std::cos(-72.8 * kOneDegree) * std::sin(13.2 * kOneDegree),
                        std::sin(-72.8 * kOneDegree));
  EXPECT_LT(panel.image(small_cloud, 0).x, 0);
  EXPECT_GT(panel.image(small_cloud, 0).y, 0);
}

TEST(PaperMult, TheStarBehindTheHoleIsTwoOnTheRingAtEqualDistances) {
  for (const char* label : {"mult", "APOD", "HD49359"}) {
    const Show show = figure(label);
    const Panel panel(show, 0);
    const V3d hole = panel.hole(), first = panel.image(star("HD 49359"), 0),
              second = panel.image(star("HD 49359"), 1);
    const double one = angle_between(first, hole), other = angle_between(second, hole);
    EXPECT_NEAR(one, other, 0.01 * kOneDegree) << label;  // it stands 0.007 degrees off the axis
    EXPECT_GT(one - other, 0) << label;
    // They lie on opposite sides of the hole, in line with it.
    EXPECT_NEAR(angle_between(first, second), one + other, 1e-9) << label;
    // The catalogue that the show draws has the star.
    ASSERT_TRUE(show.sky[SkyRegion::kI].stars);
    const StarField& field = *show.sky[SkyRegion::kI].stars;
    const auto names = read_star_catalogue(field.catalogue, field.max_magnitude).names;
    EXPECT_NE(std::ranges::find(names, "HD 49359", &NamedStar::name), names.end());
  }
}

TEST(PaperHD49359, TwoGhostsStandOnTheSegmentOneInEachPicture) {
  const Show show = figure("HD49359");
  ASSERT_EQ(frame_count(show), 2);
  int in_picture[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    const Panel panel(show, k);
    const V3d hole = panel.hole(), first = panel.image(star("HD 49359"), 0),
              second = panel.image(star("HD 49359"), 1);
    for (const int order : {2, 3}) {
      const V3d ghost = panel.image(star("HD 49359"), order);
      EXPECT_NEAR(angle_between(first, ghost) + angle_between(ghost, second),
                  angle_between(first, second), 1e-9);
      EXPECT_GT(angle_between(ghost, hole), edge_from_rest(30));
      EXPECT_LT(angle_between(ghost, hole), edge_from_rest(30) + 0.02 * kOneDegree);
      in_picture[k] += panel.shows(ghost);
    }
    // Frame 0 shows the left side.
    EXPECT_GT(hole.x * (k == 0 ? 1 : -1), 0);
    // A view ray through the ghost comes from the star.
    const V3d ghost = panel.image(star("HD 49359"), 2);
    EXPECT_LT(angle_between(panel.tracer.trace({ghost}).sky_direction, star("HD 49359")), 1e-4);
  }
  EXPECT_EQ(in_picture[0], 1);
  EXPECT_EQ(in_picture[1], 1);
}

TEST(PaperFigZ, EachZoomEndsAtTheEdgeAndTheLastIs160MilliarcsecondsWide) {
  const Show show = figure("fig_z");
  ASSERT_EQ(frame_count(show), 8);
  double before = 0;
  for (int k = 0; k < 8; ++k) {
    const Panel panel(show, k);
    const double fov = std::get<Stereographic>(panel.state.projection).fov;
    if (k == 0) {
      EXPECT_NEAR(fov, 90 * kOneDegree, 1e-12);
    }
    if (k > 0) {
      EXPECT_NEAR(before / fov, std::pow(90 * kOneDegree / (160 * kMilliarcsecond), 1 / 7.), 1e-6);
    }
    if (k == 7) {
      EXPECT_NEAR(fov / kMilliarcsecond, 160, 1e-3);
    }
    before = fov;
    // The sky is to the left, the silhouette to the right of 70 % of the width.  In the first frame
    // it is in the middle.
    EXPECT_EQ(panel.trace(0, 0.5).sky, SkyRegion::kI) << k;
    if (k > 0) {
      EXPECT_EQ(panel.trace(0.69, 0.5).sky, SkyRegion::kI) << k;
    }
    EXPECT_EQ(panel.trace(k > 0 ? 0.71 : 0.5, 0.5).sky, SkyRegion::kIV) << k;
  }
}

// Each subsequent view shows one more ghost.  The ghosts that are seen outside a view ray are
// counted by the half turns that its light makes around the hole.
TEST(PaperFigZ, TheSeventhGhostIsInTheLastView) {
  const Show show = figure("fig_z");
  const Panel first(show, 0), last(show, 7);
  // `beyond` is the angle in radians between the ray and the silhouette.
  const auto ghosts = [](const Panel& panel, double beyond) {
    const SkyTable table(schwarzschild_zone(30.0, Critical::kFirst));
    // The angle from the hole is that of the observer at rest, the table's that of free fall.
    const double alpha = edge_from_rest(30) + beyond;
    const V3d n(-std::cos(alpha), 0, std::sin(alpha));
    const V3d m = to_tetrad(panel.state.observer.celerity, n).direction;
    const double swept = table.azimuth(
        table.zone().edge.distance(std::sqrt((1 + m.x) / 2), std::sqrt((1 - m.x) / 2)));
    return swept / std::numbers::pi;
  };
  EXPECT_GT(ghosts(last, 0.3 * 160 * kMilliarcsecond), 4);
  EXPECT_GT(ghosts(last, 160 * kMilliarcsecond / 200), 6);
  EXPECT_LT(ghosts(first, 30 * kOneDegree), 1);
}

TEST(PaperFigCirc, SpeedsShiftsAndConstellations) {
  const Show show = figure("figcirc");
  ASSERT_EQ(frame_count(show), 2);
  const Panel far(show, 0), near(show, 1);
  EXPECT_EQ(far.state.observer.r, 30);
  EXPECT_EQ(near.state.observer.r, 6);
  EXPECT_NEAR(far.local_speed(), 0.189, 5e-4);
  EXPECT_NEAR(near.local_speed(), 0.5, 1e-14);
  EXPECT_NEAR(near.z(0.5, 0.5), -0.529, 5e-4);
  const V3d back = -near.in_camera(motion_direction(near.state.observer).normalized());
  EXPECT_NEAR(1 / near.tracer.trace({back}).frequency_ratio - 1, 0.414, 5e-4);
  EXPECT_GT(far.in_camera(motion_direction(far.state.observer).normalized()).x, 0.95);
  expect_quadrants(far, {{"Betelgeuse", -1, 1},
                         {"Rigel", -1, 1},
                         {"Bellatrix", -1, 1},
                         {"Alnilam", -1, 1},
                         {"Saiph", -1, 1}});
  expect_quadrants(near, {{"Dubhe", 1, -1}, {"Merak", 1, -1}, {"Alkaid", 1, -1}});
  // Taurus is at the bottom, in the middle third of the width.
  const V3d bull = far.image(star("Aldebaran"), 0);
  EXPECT_TRUE(far.shows(bull));
  EXPECT_GT(bull.y, 3 * std::abs(bull.x));
}

}  // namespace
}  // namespace domefall
