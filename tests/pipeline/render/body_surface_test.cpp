// The surfaces of bodies: limb darkening, phases and textures.
#include "pipeline/render/scene/body_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/render/frame_key.h"
#include "pipeline/render/scene/body_sight.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

using std::numbers::pi;

// An observer at r, who looks at the hole, and a sphere at rest to its side.
Show show_with_sphere(double observer, double r, double azimuth, double radius) {
  Show show = show_of(StaticObserver{observer}, Stereographic{201, 201, 40 * kDegree});
  show.spacetime = Schwarzschild{4e6};
  show.timeline[0].camera.attitude = LookAtHole{};
  show.point_spread.min_sigma = show.point_spread.max_sigma = 0.2 * kDegree;
  show.exposure.ev = 0;
  const FrameState state = frame_state(show, 0);
  Body body;
  body.trajectory = StaticObserver{r};
  body.azimuth = azimuth;
  body.magnitude = -15;
  body.radius = radius;
  body.node = {column(state.observer.sky_from_tetrad, 0)};
  body.normal = {-column(state.observer.sky_from_tetrad, 1)};
  show.bodies = {body};
  return show;
}

std::vector<BodySight::Piece> pieces_of(const Show& show) {
  const FrameState state = frame_state(show, 0);
  const BodySight sight(state, show.effects, show.least_star_radius);
  const auto image = sight.image(show.bodies[0], 0);
  return sight.pieces(show.bodies[0], *image, 1e-3);
}

// The light of all pieces, over that of the body as a point.
double light_of(const Show& show) {
  const FrameState state = frame_state(show, 0);
  const BodySight sight(state, show.effects, show.least_star_radius);
  double sum = 0;
  for (const BodySight::Piece& piece : pieces_of(show))
    sum += piece.at.amplification * luminance(piece.tint);
  return sum / sight.image(show.bodies[0], 0)->at.amplification;
}

TEST(BodySurface, IsDarkerTowardsTheLimbByTheSolarLaw) {
  for (const double radius : {1.0, 30.0}) {  // to first order, and traced
    const Show show = show_with_sphere(3000, 2000, 0.2, radius);
    EXPECT_NEAR(light_of(show), 1, 3e-3) << radius;
    const auto pieces = pieces_of(show);
    double least = HUGE_VAL, most = 0;
    const FrameState state = frame_state(show, 0);
    const BodySight sight(state, show.effects, show.least_star_radius);
    const auto image = sight.image(show.bodies[0], 0);
    const BodySurface surface(show.bodies[0], image->traced, state.observer);
    for (const double cosine : {0.0, 0.5, 1.0}) {
      const double light = surface.light(SpherePiece{{}, cosine, {}});
      EXPECT_NEAR(light, (1 - 0.6 * (1 - cosine)) / 0.8, 1e-12);
      least = std::min(least, light), most = std::max(most, light);
    }
    EXPECT_NEAR(least / most, 0.4, 1e-12);
    EXPECT_GT(pieces.size(), 16u);
  }
}

// The phase law of a sphere that scatters by Lambert's law, (sin a + (pi - a) cos a)/pi.
TEST(BodySurface, HasThePhasesOfAPlanet) {
  for (const double radius : {1.0, 30.0})
    for (const double phase : {0.0, 0.7, pi / 2, 2.5}) {
      Show show = show_with_sphere(3000, 2000, 0.2, radius);
      const V3d body = V3d(std::cos(0.2), std::sin(0.2), 0) * 2000, view = V3d(3000, 0, 0) - body;
      const V3d v = view.normalized(), aside(-v.y, v.x, 0);
      const V3d from = v * std::cos(phase) + aside * std::sin(phase);
      Body& lit = show.bodies[0];
      const V3d node = lit.node.v, onward = lit.normal.v.cross(node);
      lit.lit_from = SkyDirection{node * from.x + onward * from.y};
      const double law = (std::sin(phase) + (pi - phase) * std::cos(phase)) / pi;
      // What is nearer to the observer is seen larger.
      EXPECT_NEAR(light_of(show), law, 5e-3 + radius / 1000) << radius << " " << phase;
    }
}

TEST(BodySurface, HasItsTextureTheRightWayRound) {
  // The right half, of eastern longitudes, is red and the left half is green.
  const PanoramaFile file(64, [](int k) {
    const bool east = k / 3 % 64 >= 32;
    return k % 3 == 0 ? east ? 1.0f : 0.0f : k % 3 == 1 ? east ? 0.0f : 1.0f : 0.0f;
  });
  Show show = show_with_sphere(3000, 2000, 0.2, 30);
  Body& body = show.bodies[0];
  body.texture = file.path();
  const FrameState state = frame_state(show, 0);
  const BodySight sight(state, show.effects, show.least_star_radius);
  const auto image = sight.image(body, 0);
  const BodySurface surface(body, image->traced, state.observer);
  const V3d node = apply_transposed(state.observer.sky_from_tetrad, body.node.v),
            normal = apply_transposed(state.observer.sky_from_tetrad, body.normal.v),
            east = normal.cross(node);
  const SpherePiece eastern{{{}, 1, 1e-6}, 1, (node + east).normalized()},
      western{{{}, 1, 1e-6}, 1, (node - east).normalized()};
  EXPECT_GT(surface.tint(eastern).r, 3 * surface.tint(eastern).g);
  EXPECT_GT(surface.tint(western).g, 2 * surface.tint(western).r);
}

struct Ringed {
  Ringed(double light_across, double light_up) : show(show_with_sphere(3000, 2000, 0.2, 30)) {
    Body& body = show.bodies[0];
    body.rings = {{1.3, 1.8, 0.5, {1, 1, 1}}, {2, 2.4, 0.9, {1, 1, 1}}};
    // Light comes from along the node, and up.
    body.lit_from =
        SkyDirection{(body.node.v * light_across + body.normal.v * light_up).normalized()};
    state = frame_state(show, 0);
    image = BodySight(state, show.effects, show.least_star_radius).image(body, 0)->traced;
  }
  BodySurface surface() const { return {show.bodies[0], image, state.observer}; }
  V3d in_tetrad(double along_node, double onward, double up) const {
    const Body& body = show.bodies[0];
    const V3d across = body.normal.v.cross(body.node.v);
    return apply_transposed(state.observer.sky_from_tetrad,
                            body.node.v * along_node + across * onward + body.normal.v * up);
  }
  Show show;
  FrameState state;
  BodyImage image;
};

TEST(BodySurface, ShadowsItsRings) {
  const Ringed ringed(std::cos(0.3), std::sin(0.3));
  const BodySurface surface = ringed.surface();
  const auto light = [&](double along_node, double onward, double up) {
    return surface.light(
        RingPiece{{}, 0, ringed.in_tetrad(along_node, onward, 0), ringed.in_tetrad(0.6, 0, up), 0});
  };
  // The shadow is a cylinder about the light's direction, as wide as the body.
  const double beside = std::sqrt(1 - std::pow(1.5 * std::sin(0.3), 2));
  EXPECT_EQ(light(-1.5, beside * 0.99, 0.8), 0);
  EXPECT_GT(light(-1.5, beside * 1.01, 0.8), 0.1);
  EXPECT_GT(light(1.5, 0.5, 0.8), 0.1);
  const double end = -1 / std::sin(0.3);
  EXPECT_EQ(light(end * 0.99, 0, 0.8), 0);
  EXPECT_GT(light(end * 1.01, 0, 0.8), 0.1);
  // The side that is not lit has less light.
  EXPECT_LT(light(1.5, 0.5, -0.8), light(1.5, 0.5, 0.8));
}

TEST(BodySurface, IsShadowedByItsRings) {
  const double up = 0.4;
  const Ringed ringed(std::cos(up), std::sin(up));
  const BodySurface surface = ringed.surface();
  // The light of a southern place has come through the rings' plane at this radius.
  const auto light = [&](double radius) {
    // The place is radius along the node less t of the light's direction.
    const double b = radius * std::cos(up), t = b - std::sqrt(b * b - radius * radius + 1);
    const V3d place = ringed.in_tetrad(radius - t * std::cos(up), 0, -t * std::sin(up));
    EXPECT_NEAR(place.length(), 1, 1e-12);
    const V3d from = ringed.in_tetrad(std::cos(up), 0, std::sin(up));
    return surface.light(SpherePiece{{}, 1, place, 0}) / (1.5 * place.dot(from));
  };
  EXPECT_NEAR(light(1.29), 1, 1e-12);
  for (const double radius : {1.31, 1.5, 1.79})
    EXPECT_NEAR(light(radius), std::pow(0.5, 1 / std::sin(up)), 1e-12);
  EXPECT_NEAR(light(1.81), 1, 1e-12);
  EXPECT_NEAR(light(2.2), std::pow(0.1, 1 / std::sin(up)), 1e-12);
}

TEST(BodySurface, IsSeenThroughItsRings) {
  const Ringed ringed(1, 0);
  const BodySurface surface = ringed.surface();
  EXPECT_EQ(surface.left_by(RingCrossing{}), 1);
  EXPECT_NEAR(surface.left_by(RingCrossing{0, 1}), 0.5, 1e-12);
  EXPECT_NEAR(surface.left_by(RingCrossing{0, 0.5}), 0.25, 1e-12);
  EXPECT_NEAR(surface.left_by(RingCrossing{1, 1}), 0.1, 1e-12);
}

TEST(BodySurface, HasGranulesThatKeepItsLight) {
  Show grained = show_with_sphere(3000, 2000, 0.2, 300), even = grained;
  grained.bodies[0].granulation = 0.12;
  double sum = 0, squares = 0, light = 0;
  const auto fine = pieces_of(grained), smooth = pieces_of(even);
  ASSERT_EQ(fine.size(), smooth.size());
  for (std::size_t k = 0; k < fine.size(); ++k) {
    const double ratio = fine[k].at.amplification / smooth[k].at.amplification;
    sum += ratio, squares += ratio * ratio, light += smooth[k].at.amplification;
  }
  const double mean = sum / double(fine.size());
  EXPECT_GT(std::sqrt(squares / double(fine.size()) - mean * mean), 0.05);
  EXPECT_NEAR(light_of(grained), light_of(even), 0.01);
  // From far away nothing is left of them.
  grained = show_with_sphere(3000, 2000, 0.2, 2);
  const double before = light_of(grained);
  grained.bodies[0].granulation = 0.12;
  EXPECT_EQ(light_of(grained), before);
}

// As bright as the frame has it, beside the same body as a point.
TEST(BodySurface, IsSeenAsTheVOfItsPixels) {
  const auto light = [](const Show& show) {
    Renderer renderer(show, 1);
    FloatImage frame;
    renderer.render(frame_state(show, 0), frame);
    double sum = 0;
    for (std::size_t k = 0; k < frame.pixels.size(); k += 3)
      sum += luminance({frame.pixels[k], frame.pixels[k + 1], frame.pixels[k + 2]});
    return sum;
  };
  const auto seen_v = [](const Show& show) {
    const FrameState state = frame_state(show, 0);
    const BodySight sight(state, show.effects, show.least_star_radius);
    double sum = 0;
    for (int order = 0; order < 4; ++order) {
      const auto image = sight.image(show.bodies[0], order);
      const double v =
          sight.seen_v(show.bodies[0], image->at, sight.pieces(show.bodies[0], *image, 5e-3));
      sum += std::pow(10, -0.4 * v);
    }
    return -2.5 * std::log10(sum);
  };
  Show point = show_with_sphere(60, 10, 1.8, 0);
  Show sphere = show_with_sphere(60, 10, 1.8, 3);
  Show lit = sphere;
  lit.bodies[0].lit_from = LitFromHole{};
  for (const Show& show : {sphere, lit})
    EXPECT_NEAR(seen_v(show) - seen_v(point), -2.5 * std::log10(light(show) / light(point)), 0.03);
}

TEST(BodySurface, IsInTheKeysOfFrames) {
  const Show plain = show_with_sphere(60, 10, 1.8, 3);
  Show textured = plain, lit = plain, from_hole = plain;
  textured.bodies[0].texture = small_panorama();
  lit.bodies[0].lit_from = SkyDirection{V3d(1, 0, 0)};
  from_hole.bodies[0].lit_from = LitFromHole{};
  const FrameState state = frame_state(plain, 0);
  const auto key = [&](const Show& show) { return FrameKeys(show, "").scene(state); };
  EXPECT_NE(key(plain), key(textured));
  EXPECT_NE(key(plain), key(lit));
  EXPECT_NE(key(lit), key(from_hole));
  Show grained = plain, ringed = plain, tilted = plain;
  grained.bodies[0].granulation = 0.12;
  ringed.bodies[0].rings = {{1.5, 2, 0.5, {1, 1, 1}}};
  tilted.bodies[0].tilt = 0.1;
  for (const Show& show : {grained, ringed, tilted}) EXPECT_NE(key(plain), key(show));
  Show clearer = ringed;
  clearer.bodies[0].rings[0].opacity = 0.4;
  EXPECT_NE(key(ringed), key(clearer));
}

// A planet's night side is black before the sky, and what is left of the sky says so.
TEST(BodySurface, HidesWhatIsBehindIt) {
  Show show = show_with_sphere(3000, 2000, 0.1, 100);
  show.sky[SkyRegion::kI].background = GridSky{};
  show.point_spread.min_sigma = show.point_spread.max_sigma = 0.1 * kDegree;
  const FrameState state = frame_state(show, 0);
  // Lit from behind, as the observer sees it.
  show.bodies[0].lit_from = SkyDirection{column(state.observer.sky_from_tetrad, 0) * -1.0};
  const BodySight sight(state, show.effects, show.least_star_radius);
  const CameraDirection middle = sight.seen(sight.image(show.bodies[0], 0)->at).direction;
  const PixelPosition pixel = pixel_of(state.projection, middle).value();
  const auto at =
      static_cast<std::size_t>(std::lround(pixel.j - 1) * 201 + std::lround(pixel.i - 1));
  LayeredFloatFrame frame({Layer::kSky, Layer::kBodies});
  Renderer(show, 1).render(state, frame);
  EXPECT_NEAR(frame.find(Layer::kBodies)->alpha[at], 1, 1e-2);
  EXPECT_NEAR(frame.find(Layer::kBodies)->alpha[0], 0, 1e-6);
  EXPECT_LT(frame.picture.pixels[3 * at], 1e-2f);
  EXPECT_LT(frame.find(Layer::kSky)->light.pixels[3 * at], 1e-2f);
  Show without = show;
  without.bodies.clear();
  LayeredFloatFrame bare({Layer::kSky});
  Renderer(without, 1).render(state, bare);
  double covered = 0, dimmed = 0, before = 0;
  for (int row = 0; row < 201; ++row)
    for (int k = 0; k < 201; ++k) {
      const auto pixel_at = static_cast<std::size_t>(201 * row + k);
      covered += static_cast<double>(frame.find(Layer::kBodies)->alpha[pixel_at]) *
                 pixel_solid_angle(state.projection, {k + 1.0, row + 1.0});
      before += static_cast<double>(bare.picture.pixels[3 * pixel_at]);
      dimmed += static_cast<double>(frame.find(Layer::kSky)->light.pixels[3 * pixel_at]);
    }
  const double distance2 = 3e3 * 3e3 + 2e3 * 2e3 - 2 * 3e3 * 2e3 * std::cos(0.1);
  EXPECT_NEAR(covered / (pi * 100 * 100 / distance2), 1, 0.05);
  EXPECT_LT(dimmed, before);
}

}  // namespace
}  // namespace domefall
