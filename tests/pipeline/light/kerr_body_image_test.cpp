#include "pipeline/light/kerr_body_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/light/kerr_sphere_image.h"
#include "pipeline/light/kerr_view.h"
#include "pipeline/light/sphere_surface.h"
#include "tests/pipeline/light/resting_body.h"
#include "trajectories/kerr_orbit.h"

namespace domefall {
namespace {

using std::numbers::pi;

TEST(KerrBodyImages, AreThoseWithoutASpin) {
  const ChargedHole hole(1, 0.4);
  const KerrPlace at{{1e-9L, 0.4L}, 20, 1.1};
  for (const double phi : {0.3, 1.5, 2.9, 4.0}) {
    const V3d axis = V3d(0.3, -0.9, 0.2).normalized(),
              start = axis.cross(V3d(0, 0, 1)).normalized(),
              turned = start * std::cos(phi) + axis.cross(start) * std::sin(phi);
    const BodyMotion motion = circling_body(hole, 8, axis, turned);
    const std::vector<BodyImage> found = kerr_body_images(at, 50, motion, 1e-3);
    ASSERT_GE(found.size(), 3U);
    for (std::size_t order = 0; order < found.size() && found[order].psi < 8.5; ++order) {
      SCOPED_TRACE(testing::Message() << phi << " order " << order);
      const auto own =
          image_of_body(ChargedPlaceView{hole, 20}, 50, motion, static_cast<int>(order), 1e-3);
      ASSERT_TRUE(own);
      EXPECT_LT((found[order].direction - own->direction).length(), 1e-7);
      EXPECT_NEAR(found[order].frequency_ratio, own->frequency_ratio, 1e-7);
      EXPECT_NEAR(found[order].proper_time, own->proper_time, 1e-5);
      EXPECT_NEAR(found[order].solid_angle_per_area / own->solid_angle_per_area, 1, 1e-3);
      EXPECT_NEAR(found[order].psi, own->psi, 1e-6);
      EXPECT_LT((found[order].across - own->across).length(), 1e-6);
      EXPECT_LT((found[order].ray - own->ray).length(), 1e-6);
    }
  }
}

// A point of a motion as an observer in the tetrad at `at` knows it.
BodyPoint body_point(const KerrPlace& at, const OrbitPoint& point) {
  const auto theta = static_cast<double>(at.theta);
  const M33d axes = from_columns({std::sin(theta), 0, std::cos(theta)},
                                 {std::cos(theta), 0, -std::sin(theta)}, {0, 1, 0});
  const double s = std::sin(point.theta), c = std::cos(point.theta), phi = point.azimuth;
  const V3d place(s * std::cos(phi), s * std::sin(phi), c),
      south(c * std::cos(phi), c * std::sin(phi), -s), around(-std::sin(phi), std::cos(phi), 0);
  const V3d momentum = place.cross(south * point.celerity.y + around * point.celerity.z) * point.r;
  return {apply_transposed(axes, place), point.r,          double(point.null_time),
          gamma_of(point.celerity),      point.celerity.x, apply_transposed(axes, momentum)};
}

// What keeps its r and latitude, from an azimuth on.
BodyMotion circling(const KerrPlace& at, const KerrCircling& circle, double azimuth) {
  return {[=](double tau) {
            OrbitPoint point = circle.at(tau);
            point.azimuth += azimuth;
            return body_point(at, point);
          },
          -HUGE_VAL,
          HUGE_VAL,
          {},
          circle.r,
          circle.r};
}

KerrCircling free_circle(const KerrHole& hole, double r) {
  const KerrCircle circle = kerr_circle(hole, r, true).value();
  return {hole, r, pi / 2, circle.angle / circle.time};
}

// The exact ray of each image goes through the body at its time, and its shift is that of the ray's own
// E and L, 1 + z = u^t (E - Omega L).
TEST(KerrBodyImages, LieOnTheRaysOfTheirDirections) {
  const KerrPlace at{{0.9L, 0}, 20, pi / 3};
  const KerrCircling circle = free_circle(at.hole, 8);
  for (const double phi : {0.0, 1.0, 2.2, 3.1, 4.0, 5.2}) {
    const BodyMotion motion = circling(at, circle, phi);
    const std::vector<BodyImage> images = kerr_body_images(at, 30, motion, 1e-3);
    ASSERT_GE(images.size(), 3U);
    for (const BodyImage& image : images) {
      const KerrDirection n = kerr_direction_of(image.direction);
      const auto event = kerr_event(at, n, image.mino);
      const auto body = KerrBodyRays(at, 30, motion).body(image.proper_time);
      ASSERT_TRUE(event && body);
      EXPECT_NEAR(event->at.r, 8, 1e-8);
      EXPECT_LT((event->at.place - body->at.place).length(), 1e-8);
      EXPECT_NEAR(30 + event->null_time, body->null_time, 1e-8);
      const auto r = static_cast<double>(at.r), theta = static_cast<double>(at.theta),
                 delta = static_cast<double>(n.delta), s = std::sin(theta);
      const double sigma = r * r + 0.81 * std::cos(theta) * std::cos(theta);
      const double y = std::sqrt(sigma) * s * std::sin(delta) *
                       std::sin(static_cast<double>(n.eta)),
                   b = (1 - std::cos(delta)) / 2, gap = r * r - 2 * r + 0.81;
      const double energy = (sigma * b + (1 + std::cos(delta)) * gap / 2 + 0.9 * y) / sigma,
                   momentum = y + 0.9 * energy * s * s;
      const KerrCircle own = kerr_circle(at.hole, 8, true).value();
      EXPECT_NEAR(image.frequency_ratio * (own.time * energy - own.angle * momentum), 1, 1e-9);
      // The body is in the direction that psi and the axis say.
      const V3d told = V3d(std::cos(image.psi), 0, 0) + image.across * std::sin(image.psi);
      EXPECT_LT((told - motion.at(image.proper_time).direction).length(), 1e-9);
    }
  }
}

// How its image moves as what rests is moved says how bright it is: dn1 x dn2 for q1 x q2 in its frame.
TEST(KerrBodyImages, AreAsBrightAsTheirRaysAreWide) {
  const KerrPlace at{{0.9L, 0}, 15, 1.2};
  constexpr double kStep = 1e-4;
  const auto resting = [&](double theta, double phi) {
    const BodyMotion motion = circling(at, {at.hole, 7, theta, 0}, phi);
    return kerr_body_images(at, 0, motion, 1e-6);
  };
  for (const double phi : {0.7, 2.5, 4.4}) {
    const double theta = 1.4;
    const auto images = resting(theta, phi), south = resting(theta + kStep, phi),
               north = resting(theta - kStep, phi), east = resting(theta, phi + kStep),
               west = resting(theta, phi - kStep);
    for (std::size_t k = 0; k < 3; ++k) {
      const BodyImage& image = images.at(k);
      const V3d by_theta = (south.at(k).direction - north.at(k).direction) / (2 * kStep),
                by_phi = (east.at(k).direction - west.at(k).direction) / (2 * kStep);
      const BodyMotion motion = circling(at, {at.hole, 7, theta, 0}, phi);
      const KerrBodyRays rays(at, 0, motion);
      const auto pass = rays.pass(image.direction, image.mino, image.proper_time);
      ASSERT_TRUE(pass);
      const M33d axes = kerr_axes(pass->body.at.place);
      const auto on_screen = [&](const V3d& by_place) {
        const TetradVector x = tetrad_vector(at.hole, pass->body.at, 0, by_place, 0),
                           &u = pass->body.velocity;
        const double along = u.s.dot(x.s), time = u.t * x.t - along;
        const V3d own = x.s + u.s * (along / (u.t + 1) - x.t);
        return own - pass->leaving * time;
      };
      const V3d q1 = on_screen(column(axes, 1)), q2 = on_screen(column(axes, 2) * std::sin(theta));
      const double area = std::abs(q1.cross(q2).dot(pass->leaving));
      EXPECT_NEAR(by_theta.cross(by_phi).length() / area / image.solid_angle_per_area, 1, 1e-4)
          << phi << " " << k;
    }
  }
}

// What falls in is seen until it freezes above the horizon, and within by who is there.
TEST(KerrBodyImages, AreSeenWithinTheHole) {
  const KerrHole hole{0.8L, 0};
  const double theta = 1.3;
  const KerrOrbit orbit(hole, 6, theta, kerr_dragged(hole, 6, theta));
  const OrbitPoint passes = orbit.at(orbit.time_at(1.6, Leg::kInward).value());
  const auto crosses = double(passes.null_time);
  const auto seen_from = [&](double r, double null_time) {
    const KerrPlace at{hole, r, 1.2};
    const BodyMotion motion{[&](double tau) {
                              OrbitPoint point = orbit.at(tau);
                              point.azimuth -= passes.azimuth;
                              return body_point(at, point);
                            },
                            orbit.birth(),
                            orbit.death(),
                            {},
                            0,
                            HUGE_VAL};
    return kerr_body_images(at, null_time, motion, 1e-3);
  };
  double last = 7;
  for (const double later : {25.0, 40.0}) {
    const auto images = seen_from(20, crosses + later);
    ASSERT_FALSE(images.empty());
    EXPECT_GT(images[0].r, 1.6);
    EXPECT_LT(images[0].r, last);
    last = images[0].r;
  }
  // Who follows it closely sees it within.
  const auto within = seen_from(1.2, crosses + 0.2);
  ASSERT_FALSE(within.empty());
  EXPECT_LT(within[0].r, 1.6);
  for (const BodyImage& image : within) EXPECT_TRUE(std::isfinite(image.frequency_ratio));
}

template <class Piece>
double light_of(const std::vector<Piece>& pieces) {
  double sum = 0;
  for (const Piece& piece : pieces) sum += piece.at.amplification;
  return sum;
}

// What is seen of a sphere with two rings: the sphere, bare and through each of them, and those, with the
// means of their places.
struct RingedLight {
  explicit RingedLight(const RingedSphere& seen) {
    place.fill(V3d(0, 0, 0));
    for (const SpherePiece& piece : seen.sphere)
      add(static_cast<std::size_t>(piece.through.ring + 1), piece);
    for (const RingPiece& piece : seen.rings) add(static_cast<std::size_t>(piece.ring + 3), piece);
    for (std::size_t k = 0; k < light.size(); ++k)
      if (light[k] > 0) place[k] /= light[k];
  }
  template <class Piece>
  void add(std::size_t k, const Piece& piece) {
    light[k] += piece.at.amplification, place[k] += piece.place * piece.at.amplification;
  }
  std::array<double, 5> light{};
  std::array<V3d, 5> place;
};

// The second image against that near a hole without a spin, and the third, which is thin, as a net against
// a line along the edge.
TEST(KerrBodyImages, HaveRings) {
  const ChargedHole hole(1, 0.4);
  const Spacetime spacetime{hole};
  const KerrPlace at{{1e-9L, 0.4L}, 20, 1.1};
  const V3d axis = V3d(0.3, -0.9, 0.2).normalized(), start = axis.cross(V3d(0, 0, 1)).normalized();
  const BodyMotion motion = circling_body(hole, 8, axis, start);
  const ChargedPlaceView view{hole, 20};
  const RingPlane rings{V3d(0.3, 0.5, 0.8).normalized(), {{1.3, 1.7}, {1.8, 2.2}}};
  constexpr double kRadius = 0.1;
  const auto images = kerr_body_images(at, 50, motion, kRadius);
  ASSERT_GE(images.size(), 3U);
  const auto seen = [&](const BodyImage& image, double parts) {
    const double spacing = kerr_size_of_sphere(image, kRadius) / parts;
    const RingedSphere found = kerr_image_of_sphere(at, 50, motion, image, {}, kRadius, rings,
                                                    [=](const V3d&) { return spacing; });
    for (const RingPiece& piece : found.rings) EXPECT_EQ(rings.ring_at(piece.place), piece.ring);
    return RingedLight(found);
  };
  const auto own = image_of_body(view, 50, motion, 1, kRadius);
  const auto expected = traced_with_rings(
      {[&](double r, double psi) { return seen_place(view, 50, r, psi); }, spacetime, 20}, motion,
      own.value(), kRadius, rings,
      [spacing = size_of_sphere(*own, kRadius) / 40](const V3d&) { return spacing; });
  ASSERT_TRUE(expected);
  const RingedLight a(*expected), b = seen(images[1], 40);
  for (std::size_t k = 0; k < a.light.size(); ++k) {
    EXPECT_NEAR(b.light[k] / a.light[0], a.light[k] / a.light[0], 0.02) << k;
    EXPECT_LT((b.place[k] - a.place[k]).length(), 0.05) << k;
  }
  const RingedLight net = seen(images[2], 200), line = seen(images[2], 1);
  for (std::size_t k = 0; k < net.light.size(); ++k)
    EXPECT_NEAR(line.light[k] / net.light[0], net.light[k] / net.light[0], 0.1) << k;
}

// A sphere's image has the light of its first order where it is small, and is an arc behind the hole.
TEST(KerrBodyImages, OfSpheresAreTracedRayByRay) {
  const KerrPlace at{{0.9L, 0}, 20, 1.3};
  const KerrCircling circle = free_circle(at.hole, 8);
  const BodyMotion motion = circling(at, circle, 0.8);
  constexpr double kRadius = 0.05;
  const auto images = kerr_body_images(at, 10, motion, kRadius);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto pieces =
        kerr_image_of_sphere(at, 10, motion, images.at(k), {}, kRadius, {}, [](const V3d&) {
          return 1e-4;
        }).sphere;
    for (const SpherePiece& piece : pieces) {
      EXPECT_NEAR(piece.place.length(), 1, 1e-9);
      EXPECT_NEAR(piece.at.frequency_ratio / images[k].frequency_ratio, 1, 0.02);
    }
    EXPECT_NEAR(light_of(pieces) / (images[k].solid_angle_per_area * pi * kRadius * kRadius), 1,
                0.01);
  }
}

// Over the axis, where the tetrads of places turn by all angles, nothing changes fast.
TEST(KerrBodyImages, AreSeenOnTheAxis) {
  const KerrPlace at{{0.9L, 0}, 30, 1.2};
  constexpr double kRadius = 0.5;
  const auto seen = [&](double theta) {
    const BodyMotion motion = circling(at, {at.hole, 10, theta, 0}, 0.3);
    auto images = kerr_body_images(at, 0, motion, kRadius);
    for (std::size_t k = 0; k < std::min<std::size_t>(images.size(), 2); ++k) {
      const double first_order = images[k].solid_angle_per_area * pi * kRadius * kRadius;
      const auto pieces =
          kerr_image_of_sphere(at, 0, motion, images[k], {}, kRadius, {}, [](const V3d&) {
            return 1e-3;
          }).sphere;
      EXPECT_NEAR(light_of(pieces) / first_order, 1, 0.03) << theta << ' ' << k;
    }
    return images;
  };
  const auto beside = seen(0.02);
  ASSERT_GE(beside.size(), 3U);
  for (const double theta : {1e-3, 1e-7, 0.0}) {
    const auto images = seen(theta);
    ASSERT_EQ(images.size(), beside.size()) << theta;
    for (std::size_t k = 0; k < images.size(); ++k)
      EXPECT_NEAR(images[k].solid_angle_per_area / beside[k].solid_angle_per_area, 1, 0.03);
  }
}

// A line along the edge has the light of the image that its rays make one by one.
TEST(KerrBodyImages, OfWoundLightFollowTheEdge) {
  const KerrPlace at{{0.9L, 0}, 30, 1.4};
  constexpr double kRadius = 1;
  const BodyMotion motion = circling(at, free_circle(at.hole, 8), 150 * pi / 180);
  const auto images = kerr_body_images(at, 0, motion, kRadius);
  int arcs = 0;
  for (const BodyImage& image : images) {
    // Of those with psi > 8 the net has few squares across.
    if (image.psi < 5 || image.psi > 8) continue;
    const auto pieces_by = [&](double spacing) {
      return kerr_image_of_sphere(at, 0, motion, image, {}, kRadius, {},
                                  [=](const V3d&) { return spacing; })
          .sphere;
    };
    const auto net = pieces_by(4e-4), line = pieces_by(0.01);
    const auto length = [](const std::vector<SpherePiece>& pieces) {
      double longest = 0;
      for (const SpherePiece& a : pieces)
        longest = std::max(longest, (a.at.direction.v - pieces.front().at.direction.v).length());
      return longest;
    };
    EXPECT_NEAR(light_of(line) / light_of(net), 1, 0.03) << image.psi;
    arcs += length(line) > 0.1;
  }
  EXPECT_GT(arcs, 1);
}

}  // namespace
}  // namespace domefall
