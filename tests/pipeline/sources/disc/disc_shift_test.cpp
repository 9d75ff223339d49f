// The shift of a disc's light.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/sources/disc/disc_light.h"
#include "tests/pipeline/sources/disc/disc_tracer.h"
#include "tests/source_tree.h"

namespace domefall {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

// The angle from the hole at which an observer at rest at `at` sees light of impact parameter b.
double angle_of(double at, double b) { return std::asin(b * std::sqrt(1 - 2 / at) / at); }

// Face-on every ray has L_n = 0, and the shift is that of time alone.
TEST(DiscShift, FaceOnIsOneOverTheRootOfOneMinusThreeOverR) {
  const double at = 1e6, blue = std::sqrt(1 - 2 / at);
  for (const double r : {6.0, 7.5, 10.0, 20.0, 300.0}) {
    for (const double chi : {0.0, 1.0, 4.0}) {
      const double b = r / std::sqrt(1 - 2 / r);  // any that comes from there
      EXPECT_NEAR(shift_at_rest(at, angle_of(at, b), chi, normal_at(0), r) * std::sqrt(1 - 3 / r),
                  blue, 1e-9)
          << r;
    }
  }
}

// Seen from the plane, light of impact parameter b comes with L_n = b from the side that
// approaches, and with -b from the other one.
TEST(DiscShift, EdgeOnLimbsApproachAndRecede) {
  const double at = 1e6, blue = std::sqrt(1 - 2 / at);
  for (const double r : {6.0, 10.0, 30.0}) {
    const double b = r / std::sqrt(1 - 2 / r), still = 1 / std::sqrt(1 - 3 / r);
    const double delta = angle_of(at, b);
    const double turned = b * std::pow(r, -1.5);
    const double left = shift_at_rest(at, delta, kHalfTurn / 2, normal_at(kHalfTurn / 2), r);
    const double right = shift_at_rest(at, delta, -kHalfTurn / 2, normal_at(kHalfTurn / 2), r);
    EXPECT_NEAR(std::min(left, right), still * (1 - turned) * blue, 1e-8);
    EXPECT_NEAR(std::max(left, right), still * (1 + turned) * blue, 1e-8);
    // The normal n = -Theta: gas at chi = 90 degrees, at +Phi, moves along n x Phi = -R, away.
    EXPECT_GT(left, right);
  }
}

// ---- against four-vectors ----

using Four = std::array<double, 4>;  // t, r, and the two directions of the sphere, orthonormal

double product(const Four& a, const Four& b, double r) {
  const double f = 1 - 2 / r;
  return f * a[0] * b[0] - a[1] * b[1] / f - a[2] * b[2] - a[3] * b[3];
}

// The shift of a ray that leaves gas at r, at an angle `psi` along its way from the observer, by
// the inner product of the two four-vectors.  They are written in (t, r) and in Cartesian
// components of the sphere's tangents along the ray and across it.
double shift_of_vectors(const GasRay& ray, double r, double psi, const V3d& tangent,
                        const V3d& normal, const Four& gas, bool outward) {
  const double f = 1 - 2 / r, l = ray.momentum / r;
  const double radial = std::sqrt(ray.energy * ray.energy - f * l * l) * (outward ? 1 : -1);
  const V3d here = kPlace * std::cos(psi) + tangent * std::sin(psi);
  const V3d along = tangent * std::cos(psi) - kPlace * std::sin(psi);
  const V3d motion = normal.cross(here);  // of the gas
  const V3d across = here.cross(along);
  // Light travels against the way on which it is followed back.
  const Four k{ray.energy / f, radial, -l, 0};
  return product(k, {gas[0], gas[1], gas[2] * motion.dot(along), gas[2] * motion.dot(across)}, r);
}

TEST(DiscShift, IsTheProductOfRayAndMotion) {
  std::mt19937 random(3);
  const auto uniform = [&random](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int k = 0; k < 2000; ++k) {
    const double r = uniform(2.001, 12), at = uniform(0.5, 30);
    const NullRay view = ray_at(at, uniform(0, kHalfTurn));
    const V3d tangent = tangent_at(uniform(0, 2 * kHalfTurn)),
              normal = normal_at(uniform(0, kHalfTurn));
    const GasRay ray = disc_ray(invariants(view), kPlace, tangent, normal);
    const double f = 1 - 2 / r;
    // Only light with E > 0 that can be at r at all comes from there.
    if (!(ray.energy * ray.energy > f * std::pow(ray.momentum / r, 2)) || ray.energy < 0) continue;
    const double psi = first_crossing(kPlace, tangent, normal) + (k % 3) * kHalfTurn;
    const bool outward = k % 2 == 0;
    Four gas{};
    if (r >= 6) {
      gas = {1 / std::sqrt(1 - 3 / r), 0, 1 / std::sqrt(r - 3), 0};
    } else {
      const double speed = std::sqrt(8.0 / 9 - f * (1 + 12 / (r * r)));
      gas = {std::sqrt(8.0 / 9) / f, -speed, std::sqrt(12.0) / r, 0};
    }
    ASSERT_NEAR(product(gas, gas, r), 1, 1e-9);
    const double truth = shift_of_vectors(ray, r, psi, tangent, normal, gas, outward);
    // Next to the horizon the products cancel.
    EXPECT_NEAR(disc_shift(GasOrbits(), ray, r, outward) / truth, 1, 1e-14 / (f * f) + 1e-11)
        << r << " " << at;
    EXPECT_GT(truth, 0);
  }
}

// Gas that falls in is seen to redden for ever from outside; who falls with it sees it calmly.
TEST(DiscShift, OfPlungingGasIsRegularAtTheHorizonForLightThatFallsToo) {
  const V3d normal = normal_at(1.2), tangent = tangent_at(0.7);
  const GasRay ray = disc_ray(invariants(ray_at(1.8, 2.5)), kPlace, tangent, normal);
  ASSERT_GT(ray.energy, 0);
  const double at_horizon = disc_shift(GasOrbits(), ray, 2, false);
  EXPECT_GT(at_horizon, 0);
  EXPECT_NEAR(disc_shift(GasOrbits(), ray, 2 + 1e-9, false), at_horizon, 1e-7);
  EXPECT_GT(disc_shift(GasOrbits(), ray, 2 + 1e-9, true), 1e8);
  EXPECT_EQ(disc_shift(GasOrbits(), ray, 2, true), INFINITY);
}

TEST(DiscShift, OfGasThatBeginsToPlungeIsThatOfTheLastStableOrbit) {
  const V3d normal = normal_at(0.4), tangent = tangent_at(2);
  const GasRay ray = disc_ray(invariants(ray_at(15, 0.5)), kPlace, tangent, normal);
  for (const bool outward : {false, true})
    EXPECT_NEAR(disc_shift(GasOrbits(), ray, std::nextafter(6, 0), outward),
                disc_shift(GasOrbits(), ray, 6, outward), 1e-12);
}

}  // namespace
}  // namespace domefall
