#include "pipeline/light/sphere_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pipeline/light/resting_body.h"
#include "tests/pipeline/light/sphere_scene.h"

namespace domefall {
namespace {

using std::numbers::pi;

void expect_traced(const SphereScene& scene, int order, double least_size) {
  SCOPED_TRACE(testing::Message() << scene.observer << " " << scene.radius << " " << order);
  const PlaceView view{scene.observer, false, false};
  const auto image = image_of_body(view, 0, scene.motion, order, scene.radius);
  ASSERT_TRUE(image);
  const Spacetime spacetime{Schwarzschild{}};
  const auto place = [&](double r, double psi) { return seen_place(view, 0, r, psi); };
  const double size = size_of_sphere(*image, scene.radius);
  EXPECT_GT(size, least_size);
  const double spacing = std::min(size, 1.0) / 300;
  const auto pieces = traced_sphere({place, spacetime, scene.observer}, scene.motion, *image,
                                    scene.radius, [&](const V3d&) { return spacing; });
  ASSERT_TRUE(pieces);
  const double reach = std::asin(std::min(1.0, scene.radius / image->r)) + 0.3;
  const double from = std::max(0.0, image->psi - reach), to = image->psi + reach;
  const auto is_chord = [&](std::size_t a, std::size_t b) {
    const V3d& n = (*pieces)[a].at.direction.v;
    const V3d& m = (*pieces)[b].at.direction.v;
    return std::abs(n.y * m.z - n.z * m.y) < 1e-12 * std::hypot(n.y, n.z);
  };
  const auto angle = [&](std::size_t k) {
    const V3d& n = (*pieces)[k].at.direction.v;
    return std::atan2(std::hypot(n.y, n.z), -n.x);
  };
  const auto e = [&](std::size_t k) {
    const V3d& n = (*pieces)[k].at.direction.v;
    return V3d(0, n.y, n.z) / std::hypot(n.y, n.z);
  };
  int rims = 0;
  double worst = 0;
  for (std::size_t k = 2; k + 2 < pieces->size(); k += 97) {
    const SpherePiece& piece = (*pieces)[k];
    V3d first(0, 0, 0);
    ASSERT_TRUE(scene.meets(e(k), angle(k), from, to, &first))
        << k << " of " << pieces->size() << " angle " << angle(k) << " mu " << piece.cosine
        << " psi " << image->psi;
    // Next to the limb a place moves without bound.
    worst = std::max(worst, (first - piece.place).length() * piece.cosine);
  }
  EXPECT_LT(worst * size, 0.1 * kPixel);
  // The first pieces of chords are next to the rim; the rest of one ends half a piece further.
  std::size_t chords = 0;
  for (std::size_t k = 1; k + 2 < pieces->size(); ++k) {
    if (is_chord(k - 1, k) || !is_chord(k, k + 2) || chords++ % 29 != 0) continue;
    const double a = angle(k), b = angle(k + 1), c = angle(k + 2);
    const double rim = (15 * a - 10 * b + 3 * c) / 8;  // a parabola's, half a piece before
    const double off = std::copysign(std::min(0.1 * kPixel, std::abs(b - a)), b - a);
    if (std::sin(rim) < 1e-3) continue;
    EXPECT_TRUE(scene.meets(e(k), rim + off, from, to)) << k;
    EXPECT_FALSE(scene.meets(e(k), rim - off, from, to)) << k;
    ++rims;
  }
  EXPECT_GT(rims, 5);
}

TEST(SphereSurface, IsWhereRaysMeetIt) {
  for (const int order : {0, 1, 2}) {
    expect_traced({12, resting_body(10, V3d(std::cos(1.5), std::sin(1.5), 0)), 2.5}, order, 1e-4);
    expect_traced({30, circling(8, 2.2), 2}, order, 1e-4);
  }
}

TEST(SphereSurface, MayFillHalfTheSky) {
  expect_traced({30, resting_body(33, V3d(std::cos(0.02), std::sin(0.02), 0)), 2.85}, 0, 1);
  expect_traced({12, resting_body(12, V3d(std::cos(0.4), std::sin(0.4), 0)), 4.2}, 0, 1);
}

TEST(SphereSurface, IsARingBehindTheHole) {
  for (const int order : {0, 1}) {
    expect_traced({30, resting_body(10, V3d(std::cos(3.0), std::sin(3.0), 0)), 3}, order, 0.1);
    expect_traced({15, circling(7, -1), 3.5}, order, 0.1);
  }
}

TEST(SphereSurface, IsSeenFromWithinTheHole) {
  expect_traced({1.5, resting_body(6, V3d(std::cos(0.7), std::sin(0.7), 0)), 2}, 0, 0.1);
}

}  // namespace
}  // namespace domefall
