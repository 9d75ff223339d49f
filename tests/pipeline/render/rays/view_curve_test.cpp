// The curves of overlays are held against frames and against the images of stars, which are found
// in other ways.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/light/aberration.h"
#include "pipeline/light/hole_optics.h"
#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

std::vector<ViewCircle> circles_of(const FrameState& state, bool rings) {
  const ViewTracer tracer(state, WantedSkies{});
  std::vector<ViewCircle> circles;
  if (rings)
    for (const ViewCurve& ring : tracer.einstein_rings())
      circles.push_back(std::get<ViewCircle>(ring));
  else
    for (const SkyBorder& border : tracer.borders())
      circles.push_back(std::get<ViewCircle>(border.curve));
  return circles;
}

struct CirclePlace {
  const char* name;
  GivenVelocity observer;
  std::size_t skies;
};

const CirclePlace kPlaces[] = {
    {"at rest outside", {Region::kI, Tetrad::kRain, 8, resting_celerity(8)}, 1},
    {"in motion", {Region::kI, Tetrad::kRain, 5, {0.4, -0.9, 0.6}}, 1},
    {"within the light circle", {Region::kI, Tetrad::kRain, 2.4, {0.1, 0, 0.3}}, 1},
    {"on the way out", {Region::kI, Tetrad::kOutgoing, 4, {0.3, 0.2, 0}}, 1},
    {"inside", {Region::kII, Tetrad::kRain, 1.2, {0.1, 0.5, 0.2}}, 2},
    {"inside from the other side", {Region::kII, Tetrad::kRainOfThree, 0.7, {0, 0.4, 0}}, 2},
    {"in the second universe", {Region::kIII, Tetrad::kRainOfThree, 6, {0, 0, 0.4}}, 1},
};

double angle_from(const ViewCircle& circle, const CameraDirection& n) {
  const double cosine = n.v.dot(circle.axis);
  return std::atan2(n.v.cross(circle.axis).length(), cosine) -
         std::atan2(circle.sine, circle.cosine);
}

// Every pixel of a frame is lit beyond the silhouette and dark within it, but for those that the
// curve passes at less than a pixel.
TEST(SilhouetteCircles, AreTheEdgesOfWhatIsDarkInAFrame) {
  for (const CirclePlace& place : kPlaces) {
    Show show = show_of(place.observer, Domemaster{80});
    show.sky[SkyRegion::kI].background = show.sky[SkyRegion::kIII].background = GridSky{};
    const FrameState state = frame_state(show, 0);
    const auto circles = circles_of(state, false);
    ASSERT_EQ(circles.size(), place.skies) << place.name;
    const HalfFrame frame = Renderer(show, 1).render(state);
    const double pixel = largest_pixel_angle(show.projection);
    int dark = 0, wrong = 0;
    for (int y = 0; y < frame.height; ++y) {
      const ColumnRange inside = inside_columns(show.projection, y);
      for (int x = inside.first; x <= inside.last; ++x) {
        const CameraDirection n = direction_at(show.projection, {x + 1.0, y + 1.0});
        // Of the outgoing tetrad the angle counts from the direction away from the hole.
        const double sign = is_outgoing(state.observer.tetrad) ? -1 : 1;
        const double beyond = sign * angle_from(circles[0], n);
        const double within = circles.size() > 1 ? -angle_from(circles[1], n) : -HUGE_VAL;
        if (std::abs(beyond) < pixel || std::abs(within) < pixel) continue;
        const bool lit = frame.row(y)[3 * x + 1] > 0;
        dark += !lit;
        wrong += lit != (beyond > 0 || within > 0);
      }
    }
    EXPECT_EQ(wrong, 0) << place.name;
    EXPECT_GT(dark, 5) << place.name;
  }
}

// Of a star a hair off the axis behind the hole the first two images lie on either side of the
// ring, as far from it as the star is from the axis, or nearer.
TEST(EinsteinCircles, HoldTheImagesOfAStarBehindTheHole) {
  constexpr double kOff = 1e-4;
  for (const CirclePlace& place : kPlaces) {
    const Show show = show_of(place.observer, Domemaster{64});
    const FrameState state = frame_state(show, 0);
    const ObserverState& o = state.observer;
    const auto circles = circles_of(state, true);
    ASSERT_EQ(circles.size(), place.skies) << place.name;
    const HoleOptics optics = make_hole_optics(o.r, o.tetrad, {{true, true, false}, false});
    for (std::size_t k = 0; k < circles.size(); ++k)
      for (const double turn : {0., 1., 2.5, 4.})
        for (const int order : {0, 1}) {
          const V3d source(-std::cos(kOff), std::sin(kOff) * std::cos(turn),
                           std::sin(kOff) * std::sin(turn));
          const SkyImage image = image_of(&*optics.parts.at(k).table, source, order, 1e-9);
          const V3d seen = to_observer(o.celerity, image.direction.v).direction;
          const double off = angle_from(circles[k], {apply_transposed(o.tetrad_from_camera, seen)});
          EXPECT_LT(std::abs(off), 4 * kOff) << place.name << ", sky " << k;
          EXPECT_GT(std::abs(off), 1e-12) << place.name << ", sky " << k;
        }
  }
}

TEST(EinsteinCircles, AreFarAwayAsDeflectionsAreWeak) {
  // At r the ring has the angle sqrt(4 M/r): [Einstein 1936], to first order.
  const Show show = show_of(StaticObserver{1e6}, Domemaster{64});
  const ViewCircle ring = circles_of(frame_state(show, 0), true).at(0);
  EXPECT_NEAR(std::atan2(ring.sine, ring.cosine) / std::sqrt(4 / 1e6), 1, 2e-3);
}

TEST(ViewCircles, AreNoneWhereNoSkyIsSeenAndInFlatSpace) {
  for (const auto& observer :
       {GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.2, {0, 0.3, 0}}, GivenVelocity{}}) {
    const FrameState state = frame_state(show_of(observer, Domemaster{64}), 0);
    EXPECT_TRUE(circles_of(state, false).empty());
    EXPECT_TRUE(circles_of(state, true).empty());
  }
}

}  // namespace
}  // namespace domefall
