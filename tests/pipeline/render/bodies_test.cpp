// Bodies near the hole as frames show them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/render/disc_scene.h"
#include "pipeline/render/frame_key.h"
#include "pipeline/render/overlay/star_labels.h"
#include "pipeline/render/pixel_probe.h"
#include "pipeline/render/scene/body_sight.h"
#include "pipeline/render/shutter.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// A static observer at r, who looks at the hole with 40 degrees of view, and one body in the plane
// of the first orbit; the image is small in angle, so that light adds up by pixels.
Show show_with(double r, const Body& body) {
  Show show = show_of(StaticObserver{r}, Stereographic{201, 201, 40 * kDegree});
  show.spacetime = Schwarzschild{4e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  show.point_spread.min_sigma = 0.6 * kDegree;
  show.point_spread.max_sigma = 1 * kDegree;
  show.exposure.ev = 0;
  Body placed = body;
  const FrameState state = frame_state(show, 0);
  placed.node = {column(state.observer.sky_from_tetrad, 0)};
  placed.normal = {-column(state.observer.sky_from_tetrad, 1)};
  show.bodies = {placed};
  return show;
}

FloatImage body_frame(const Show& show) {
  Renderer renderer(show, 1);
  FloatImage frame;
  renderer.render(frame_state(show, 0), frame);
  return frame;
}

struct Light {
  double sum = 0, x = 0, y = 0;  // of green, and its middle in pixels from that of the image
};
Light light_of(const FloatImage& frame) {
  Light light;
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column) {
      const double green = frame.row(row)[3 * column + 1];
      light.sum += green;
      light.x += green * (column - (frame.width - 1) / 2.0);
      light.y += green * (row - (frame.height - 1) / 2.0);
    }
  light.x /= light.sum;
  light.y /= light.sum;
  return light;
}

Body body_at(double r, double azimuth, double magnitude) {
  Body body;
  body.trajectory = CircularOrbit{r};
  body.azimuth = azimuth;
  body.magnitude = magnitude;
  return body;
}

// The azimuth at v = 0 of a body that is seen at the azimuth `seen`: it goes on meanwhile.
double azimuth_seen_at(double r, double seen, double observer) {
  const double rate = std::pow(r, -1.5);
  const auto place = image_of_place({observer, false, false}, r, seen, 0);
  return seen - rate * place->null_time;
}

TEST(Bodies, InFrontOfTheHoleAreSeenAgainstIt) {
  const Show show = show_with(30, body_at(10, azimuth_seen_at(10, 0.02, 30), -20));
  const Light light = light_of(body_frame(show));
  EXPECT_GT(light.sum, 0);
  const double pixels_of_hole = std::asin(std::sqrt(27.0) * std::sqrt(1 - 2 / 30.0) / 30) /
                                largest_pixel_angle(show.projection);
  // The direct image has nearly all of the light, far within the silhouette.
  EXPECT_LT(std::hypot(light.x, light.y), pixels_of_hole / 3);
  EXPECT_GT(pixels_of_hole, 30);
}

TEST(Bodies, AreAsBrightAsTheyAreNear) {
  const auto light_from = [](double observer) {
    Show show = show_with(observer, body_at(5000, 0, -28));
    const FrameState state = frame_state(show, 0);
    show.bodies[0].normal = {column(state.observer.sky_from_tetrad, 0)};  // seen from above
    show.bodies[0].node = {column(state.observer.sky_from_tetrad, 1)};
    // Of a stereographic image pixels cover cos^4(theta/2) of what the central one does.
    const double half = std::cos(std::atan(5000 / observer) / 2);
    return light_of(body_frame(show)).sum * half * half * half * half;
  };
  // What bends light so far out is a part of 2 M in 5000.
  const double near = light_from(5e4), far = light_from(1e5);
  EXPECT_NEAR(near / far, (1e10 + 25e6) / (25e8 + 25e6), 0.004);
}

TEST(Bodies, GrowTenfoldWithTwoMagnitudesAndAHalf) {
  const double bright = light_of(body_frame(show_with(30, body_at(10, 1, -17.5)))).sum;
  const double faint = light_of(body_frame(show_with(30, body_at(10, 1, -15)))).sum;
  EXPECT_NEAR(bright / faint, 10, 0.01);
}

TEST(Bodies, AreNotSeenFromWithin) {
  Body body = body_at(30, 0, -20);
  body.trajectory = StaticObserver{30};
  body.radius = 0.1;
  for (const double value : body_frame(show_with(30, body)).pixels) ASSERT_EQ(value, 0);
  body.azimuth = 0.01;
  EXPECT_GT(light_of(body_frame(show_with(30, body))).sum, 0);
}

// The light that it sent around the hole comes back as a ring about the hole's silhouette.
TEST(Bodies, AreSeenByTheirRiderAroundTheHole) {
  Body body = body_at(30, 0, -20);
  body.trajectory = StaticObserver{30};
  const Show show = show_with(30, body);
  const FrameState state = frame_state(show, 0);
  const BodySight sight(state, show.effects, show.least_star_radius);
  EXPECT_EQ(sight.first_order(show.bodies[0]), 1);
  const FloatImage frame = body_frame(show);
  EXPECT_GT(light_of(frame).sum, 0);
  EXPECT_EQ(frame.row(100)[3 * 100], 0);  // the body itself would be anywhere
  const double silhouette = std::asin(std::sqrt(27.0) * std::sqrt(1 - 2 / 30.0) / 30) /
                            largest_pixel_angle(show.projection);
  int brightest = 100;
  for (int column = 101; column < 201; ++column)
    if (frame.row(100)[3 * column] > frame.row(100)[3 * brightest]) brightest = column;
  EXPECT_NEAR(brightest - 100, silhouette, 2);
}

// The sky, which stands, would not ask for more than one instant.
TEST(Bodies, ThatMoveBlurWhereTheSkyStands) {
  Show show = show_with(30, body_at(10, 1, -20));
  show.timeline[0].duration_s = 10;
  show.timeline[0].timing = {0, 30};  // 3 M a second
  show.frames_per_second = 1;
  const auto width = [&] {
    Renderer renderer(show, 1);
    FloatImage frame;
    renderer.render(frame_state(show, 2), frame);
    float most = 0;
    for (const float value : frame.pixels) most = std::max(most, value);
    return light_of(frame).sum / most;  // in pixels of the brightest value
  };
  const double still = width();
  show.exposure.shutter = 1;
  LensStore lenses;
  EXPECT_EQ(instants_for(show, frame_state(show, 2), lenses), 1);
  EXPECT_GT(width(), 1.5 * still);
}

// The area (sr) of the pixels that are brighter than a third of the brightest, as the blurred limb is.
double bright_area(const FloatImage& frame, const Projection& projection) {
  float most = 0;
  for (const float value : frame.pixels) most = std::max(most, value);
  int count = 0;
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column)
      if (frame.row(row)[3 * column] > most / 3) ++count;
  const double side = largest_pixel_angle(projection);
  return count * side * side;
}

TEST(Bodies, OfASizeAreSpheresOfTheSameLight) {
  Show show = show_with(30, body_at(10, azimuth_seen_at(10, 0.5, 30), -15));
  show.point_spread.min_sigma = show.point_spread.max_sigma = 0.2 * kDegree;
  const double as_point = light_of(body_frame(show)).sum;
  show.bodies[0].radius = 0.7;
  const FloatImage frame = body_frame(show);
  EXPECT_NEAR(light_of(frame).sum / as_point, 1, 0.01);
  const FrameState state = frame_state(show, 0);
  const BodySight sight(state, show.effects, show.least_star_radius);
  const auto image = sight.image(show.bodies[0], 0);
  ASSERT_TRUE(image);
  // What the observer's motion against the tetrad does to light, it does to areas.
  const double stretch = sight.seen(image->at).frequency_ratio / image->at.frequency_ratio;
  const double area = std::numbers::pi * 0.49 * image->traced.solid_angle_per_area;
  EXPECT_NEAR(bright_area(frame, show.projection) / (area / (stretch * stretch)), 1, 0.04);
}

// The images of both sides meet in a ring as the body goes through the axis.
TEST(Bodies, StraightBehindTheHoleAreRings) {
  for (const double off : {0.0, 0.02}) {
    Show show = show_with(30, body_at(10, azimuth_seen_at(10, std::numbers::pi - off, 30), -8));
    show.point_spread.min_sigma = show.point_spread.max_sigma = 0.2 * kDegree;
    show.bodies[0].radius = 0.3;
    const FloatImage frame = body_frame(show);
    std::array<double, 8> sector{};
    double total = 0;
    for (int row = 0; row < frame.height; ++row)
      for (int column = 0; column < frame.width; ++column) {
        const double azimuth = std::atan2(row - 100, column - 100) + std::numbers::pi;
        const auto k = static_cast<std::size_t>(azimuth / (std::numbers::pi / 4) + 0.5) % 8;
        sector[k] += frame.row(row)[3 * column + 1];
        total += frame.row(row)[3 * column + 1];
      }
    for (const double light : sector) EXPECT_GT(light, total / 40) << off;
    // Left and right of the body, which moves across.
    EXPECT_NEAR(sector[2] / sector[6], 1, 0.02) << off;
  }
}

// A body at rest straight before the hole, or beyond the observer at 30.
Body body_in_line(double r, double radius, double magnitude) {
  Body body = body_at(r, 0, magnitude);
  body.trajectory = StaticObserver{r};
  body.radius = radius;
  return body;
}

// Some of them, named by their places in the list.
Show show_in_line(const std::vector<Body>& bodies) {
  Show show = show_with(30, bodies[0]);
  const Body placed = show.bodies[0];
  show.bodies.clear();
  for (Body body : bodies) {
    body.node = placed.node, body.normal = placed.normal;
    body.name = std::to_string(show.bodies.size());
    show.bodies.push_back(body);
  }
  if (reach(bodies[0].trajectory).first > 30) show.timeline[0].camera.attitude = LookOutward{};
  show.point_spread.min_sigma = show.point_spread.max_sigma = 0.2 * kDegree;
  return show;
}

// Their frame, in which only the direct images are looked at.
FloatImage frame_in_line(const std::vector<Body>& bodies) {
  FloatImage frame = body_frame(show_in_line(bodies));
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column)
      if (std::hypot(row - 100, column - 100) > 40)
        std::fill_n(frame.row(row) + std::ptrdiff_t{3} * column, 3, 0.0f);
  return frame;
}

// The nearer one hides the other, in whatever order the show names them.  Light that comes straight from
// beyond the observer has one v all along.
TEST(Bodies, HideThoseBehindThem) {
  struct Line {
    double near, far, unit;  // M; of radii
  };
  for (const Line& line : {Line{20, 10, 1}, Line{36, 45, 0.6}}) {
    const Body wide = body_in_line(line.near, line.unit, -8),
               narrow = body_in_line(line.near, 0.2 * line.unit, -8),
               spark = body_in_line(line.near, 0, -8),
               ball = body_in_line(line.far, line.unit, -14), star = body_in_line(line.far, 0, -14),
               pea = body_in_line(line.far, 0.5 * line.unit, -14);
    const double hidden = light_of(frame_in_line({wide})).sum;
    const auto expect_hidden = [&](const Body& behind, const std::vector<Body>& both) {
      const double alone = light_of(frame_in_line({behind})).sum;
      EXPECT_GT(alone, 20 * hidden);
      EXPECT_NEAR(light_of(frame_in_line(both)).sum, hidden, 1e-6 * alone);
    };
    expect_hidden(star, {star, wide});
    expect_hidden(pea, {wide, pea});
    const FloatImage small = frame_in_line({narrow}), large = frame_in_line({ball});
    for (const FloatImage& both : {frame_in_line({narrow, ball}), frame_in_line({ball, narrow})}) {
      const float *middle = both.row(100) + 3 * 100, *alone = small.row(100) + 3 * 100;
      EXPECT_NEAR(middle[1] / alone[1], 1, 0.01) << line.near;
      const double left = light_of(both).sum / (light_of(large).sum + light_of(small).sum);
      EXPECT_GT(left, 0.6);
      EXPECT_LT(left, 0.98);
    }
    // A point hides nothing.
    EXPECT_NEAR(light_of(frame_in_line({spark, ball})).sum /
                    (light_of(frame_in_line({spark})).sum + light_of(large).sum),
                1, 1e-5);
  }
}

// Who asks for a pixel is told what is seen there, and only that has a name.
TEST(Bodies, ThatAreHiddenAreNotTold) {
  const Body wide = body_in_line(20, 1, -8), spark = body_in_line(20, 0, -8),
             star = body_in_line(10, 0, -14);
  const auto told = [](const Show& show, double column) {
    std::vector<std::string> names;
    for (const BodyAtPixel& body : PixelProbe(show, frame_state(show, 0), {column, 101}).bodies())
      if (body.order == 0) names.push_back(body.name);
    return names;
  };
  const auto named = [](const Show& show) {
    std::vector<std::string> names;
    for (const NamedImage& image : StarLabels(show).images(frame_state(show, 0)))
      if (!image.secondary) names.push_back(image.name);
    return names;
  };
  using Names = std::vector<std::string>;
  const Show hidden = show_in_line({star, wide}), beside = show_in_line({star, spark});
  EXPECT_EQ(told(hidden, 101), Names{"1"});
  EXPECT_EQ(named(hidden), Names{"1"});
  EXPECT_EQ(told(beside, 101), (Names{"0", "1"}));
  EXPECT_EQ(named(beside), (Names{"0", "1"}));
  // A sphere of 1 M at 10 M is seen within some 30 pixels of 0.2 degrees.
  const auto left = [&](double column) {
    return PixelProbe(hidden, frame_state(hidden, 0), {column, 101}).left_by_bodies();
  };
  const FrameState state = frame_state(hidden, 0);
  const BodySight sight(state, hidden.effects, hidden.least_star_radius);
  const auto reach = [&](const Body& body) { return sight.reach(body, *sight.image(body, 0)); };
  EXPECT_NEAR(reach(hidden.bodies[1]), 0.1, 0.02);
  EXPECT_EQ(reach(hidden.bodies[0]), 0);
  EXPECT_EQ(left(101), 0);
  EXPECT_EQ(left(120), 0);
  EXPECT_EQ(left(140), 1);
}

// Discs that stand across the orbit, in a plane at an azimuth between the observer's and the body's
// or beyond both.  The direct light crosses the first at r = 14.
TEST(Bodies, AreHiddenByADiscBeforeThem) {
  const Show show = show_with(30, body_at(10, azimuth_seen_at(10, 0.6, 30), -14));
  const M33d axes = frame_state(show, 0).observer.sky_from_tetrad;
  const double alone = light_of(body_frame(show)).sum;
  const auto light_left = [&](double azimuth, double inner, double opacity) {
    Show hidden = show;
    Disc& disc = hidden.disc.emplace();
    disc.normal = {column(axes, 2) * std::cos(azimuth) - column(axes, 0) * std::sin(azimuth)};
    disc.node = {column(axes, 1)};
    disc.inner = inner, disc.outer = 26, disc.opacity = opacity;
    disc.luminance = 1e-12;
    return light_of(body_frame(hidden)).sum / alone;
  };
  // What is hidden has no name, but the image that comes around the hole on the other side has.
  const auto names = [&](double opacity) {
    Show hidden = show;
    hidden.bodies[0].name = "beacon";
    Disc& disc = hidden.disc.emplace();
    disc.normal = {column(axes, 2) * std::cos(0.3) - column(axes, 0) * std::sin(0.3)};
    disc.node = {column(axes, 1)};
    disc.outer = 26, disc.opacity = opacity;
    const FrameState state = frame_state(hidden, 0);
    const DiscScene scene(hidden, state);
    return StarLabels(hidden).images(state, [&](const CameraDirection& from, double psi) {
      return scene.left_before(from, psi, 0.01);
    });
  };
  const auto seen = names(1e-9), hidden = names(1);
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen[0].name, "beacon");
  EXPECT_TRUE(std::ranges::none_of(hidden, [](const auto& image) { return !image.secondary; }));
  EXPECT_LT(light_left(0.3, 6, 1), 0.05);
  EXPECT_NEAR(light_left(0.3, 6, 0.25), 0.75, 0.03);
  EXPECT_GT(light_left(0.3, 20, 1), 0.95);
  EXPECT_GT(light_left(1.2, 6, 1), 0.9);
}

TEST(Bodies, AreNamedAtTheirFirstTwoImages) {
  Show show = show_with(30, body_at(10, 1, -15));
  show.bodies[0].name = "beacon";
  const FrameState state = frame_state(show, 0);
  const std::vector<NamedImage> named = StarLabels(show).images(state);
  ASSERT_EQ(named.size(), 2u);
  EXPECT_EQ(named[0].name, "beacon");
  EXPECT_EQ(named[1].name, "beacon\u2032");
  EXPECT_LT(named[0].magnitude, named[1].magnitude);
  const BodySight sight(state, show.effects, show.least_star_radius);
  for (int order = 0; order < 2; ++order) {
    const V3d seen = sight.seen(sight.image(show.bodies[0], order)->at).direction.v;
    EXPECT_LT((named[static_cast<std::size_t>(order)].direction.v - seen).length(), 1e-12);
  }
  show.bodies[0].magnitude = 15;
  EXPECT_TRUE(StarLabels(show).images(state).empty());
}

TEST(Bodies, AreSeenFromBeyondTheHorizon) {
  Show show = show_with(30, body_at(10, 1, -18));
  show.timeline[0].trajectory = RadialInfall{1.2};
  show.timeline[0].camera.attitude = LookOutward{};
  show.projection = Domemaster{128};
  EXPECT_GT(light_of(body_frame(show)).sum, 0);
}

TEST(Bodies, AndTheirTimeAreInTheKeysOfFrames) {
  Show show = show_with(30, body_at(10, 1, -15));
  const FrameState now = frame_state(show, 0);
  FrameState later = now;
  later.observer.null_time += 1;
  Show none = show;
  none.bodies.clear();
  const FrameKeys with(show, ""), without(none, "");
  EXPECT_NE(with.scene(now), without.scene(now));
  EXPECT_NE(with.scene(now), with.scene(later));
  EXPECT_EQ(without.scene(now), without.scene(later));
}

}  // namespace
}  // namespace domefall
