// The disc as it is rendered, from closed forms, against the disc of rays that are followed.
#include "tests/pipeline/render/disc/reference_disc.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <random>

#include "pipeline/light/aberration.h"
#include "pipeline/light/emission_time.h"
#include "pipeline/light/ray_position.h"
#include "pipeline/sources/disc/disc_light.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

constexpr double kPi = std::numbers::pi;

class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  V3d direction() {
    const double z = between(-1, 1), angle = between(0, 2 * kPi), flat = std::sqrt(1 - z * z);
    return {flat * std::cos(angle), flat * std::sin(angle), z};
  }

 private:
  std::mt19937 random_;
};

Vector3 components(const V3d& v) { return {v.x, v.y, v.z}; }

struct ClosedPlace {
  int order;
  double r, one_plus_z;
};

// The same by the closed form of places along rays.
std::vector<ClosedPlace> closed_places(const ReferenceDiscView& view, const V3d& direction,
                                       int orders) {
  const V3d celerity(view.celerity[0], view.celerity[1], view.celerity[2]);
  const V3d normal(view.normal[0], view.normal[1], view.normal[2]);
  const AberratedLight light = to_tetrad(celerity, direction);
  const V3d n = light.direction;
  const double tangential = std::hypot(n.y, n.z), from_hole = std::atan2(tangential, -n.x);
  const NullRay ray =
      ray_at(view.r, view.outgoing ? kPi - from_hole : from_hole, {view.outgoing, false});
  const V3d place(1, 0, 0), tangent = V3d(0, n.y, n.z) / tangential;
  const GasRay disc = disc_ray(invariants(ray), place, tangent, normal);
  std::vector<ClosedPlace> found;
  if (!(disc.energy > 0) || (view.outgoing && view.r <= 2)) return found;
  double psi = std::atan2(-normal.dot(place), normal.dot(tangent));
  if (psi < 0) psi += kPi;
  // From within the plane the observer's own place is no crossing.
  if (psi == 0) psi = kPi;
  for (int order = 0; order < orders; ++order, psi += kPi) {
    const auto r = exact_position(ray, psi);
    if (!r || *r < 2 + 1e-5 || *r < view.inner || *r > view.outer) continue;
    const double onwards = exact_position(ray, psi + 1e-6).value_or(1e300);
    found.push_back(
        {order, *r, disc_shift(GasOrbits(), disc, *r, onwards < *r) * light.frequency_ratio});
  }
  return found;
}

// Twenty scenes: outside, between the images, next to the light circle, inside both horizons, at
// rest, in free fall and fast, above the plane, close to it and within.
std::vector<ReferenceDiscView> twenty_scenes() {
  Numbers numbers(11);
  std::vector<ReferenceDiscView> scenes;
  for (const double r : {1000.0, 50.0, 25.0, 15.0, 9.0, 6.5, 4.0, 3.0, 2.5, 2.05})
    scenes.push_back({r, false, {0, 0, 0}, components(numbers.direction()), 6, 20, false});
  for (const double r : {1.9, 1.0, 0.3})
    scenes.push_back({r, false, {0, 0, 0}, components(numbers.direction()), 2, 12, true});
  for (const double r : {8.0, 3.5, 2.2})
    scenes.push_back({r, true, {0.1, 0, 0}, components(numbers.direction()), 2, 25, true});
  scenes.push_back({12, false, {0.4, -0.2, 0.5}, {0, -1, 0}, 6, 20, false});
  scenes.push_back({10, false, {3, 1, -2}, {0.01, -1, 0}, 6, 30, false});
  scenes.push_back({10, true, {-0.5, 0.3, 0.1}, {0.7, 0.7, 0.1}, 7, 30, false});
  scenes.push_back({1.5, false, {-1, 0.5, 2}, components(numbers.direction()), 4, 20, true});
  for (ReferenceDiscView& scene : scenes) {
    const double length =
        std::sqrt(scene.normal[0] * scene.normal[0] + scene.normal[1] * scene.normal[1] +
                  scene.normal[2] * scene.normal[2]);
    for (double& v : scene.normal) v /= length;
  }
  return scenes;
}

// Anywhere, or within 1e-5 to 1 radian of the silhouette's edge, where all images of the disc are.
V3d some_direction(Numbers& numbers, const ReferenceDiscView& view, bool anywhere) {
  if (anywhere) return numbers.direction();
  const double edge = 2 * std::atan(tan_half_critical(
                              view.r, view.outgoing ? Critical::kSecond : Critical::kFirst));
  const double offset =
      std::pow(10, numbers.between(-5, 0)) * (numbers.between(-1, 3) > 0 ? 1 : -1);
  const double delta = (view.outgoing ? kPi - edge : edge) + offset;
  const double chi = numbers.between(0, 2 * kPi);
  const V3d n(-std::cos(delta), std::sin(delta) * std::cos(chi), std::sin(delta) * std::sin(chi));
  const V3d celerity(view.celerity[0], view.celerity[1], view.celerity[2]);
  return to_observer(celerity, n).direction;
}

TEST(ReferenceDisc, AgreesWithTheClosedFormInTwentyScenes) {
  constexpr int kOrders = 4;
  Numbers numbers(5);
  int seen = 0, of_rings = 0;
  const std::vector<ReferenceDiscView> scenes = twenty_scenes();
  ASSERT_EQ(scenes.size(), 20u);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (int pixel = 0; pixel < 60; ++pixel) {
      const V3d direction = some_direction(numbers, scenes[s], pixel % 3 == 0);
      const auto followed = reference_disc(scenes[s], components(direction), kOrders);
      const auto closed = closed_places(scenes[s], direction, kOrders);
      ASSERT_EQ(followed.size(), closed.size()) << s << " " << direction;
      for (std::size_t k = 0; k < closed.size(); ++k) {
        const double tolerance = 1e-9 * std::exp(kPi * closed[k].order);
        EXPECT_EQ(followed[k].order, closed[k].order);
        EXPECT_NEAR(followed[k].r / closed[k].r, 1, tolerance) << s << " " << direction;
        EXPECT_NEAR(followed[k].one_plus_z / closed[k].one_plus_z, 1, tolerance)
            << s << " " << direction << " " << closed[k].r;
        EXPECT_TRUE(std::isfinite(followed[k].delay));
        ++seen;
        of_rings += closed[k].order > 0;
      }
    }
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(of_rings, 30);
}

TEST(ReferenceDisc, HasTheSameTemperatures) {
  for (const bool plunging : {false, true}) {
    Disc disc;
    disc.plunging = plunging;
    const DiscLight light(disc);
    for (const double r : {2.5, 5.0, 6.2, 9.55, 30.0}) {
      // Straight down onto gas at r, from above it.
      const double above = 1e-3, at = std::hypot(r, above);
      const ReferenceDiscView view{at, false, {0, 0, 0}, {above / at, -r / at, 0}, 2, 40, plunging};
      const auto places = reference_disc(view, {0, 1, 0}, 1);
      ASSERT_EQ(places.size(), 1u);
      EXPECT_NEAR(places[0].temperature * 1e4, light.temperature(places[0].r), 1e-6);
    }
  }
}

// Light that comes straight to an observer moves outwards all the way: t = int dr E/(f |k^r|).
TEST(ReferenceDisc, CountsTheTimeOfFlight) {
  for (const double delta : {0.2, 0.35, 0.5}) {
    const double at = 40;
    const ReferenceDiscView view{at, false, {0, 0, 0}, {std::sqrt(0.5), std::sqrt(0.5), 0}, 2, 40};
    const auto places = reference_disc(view, {-std::cos(delta), -std::sin(delta), 0}, 1);
    ASSERT_EQ(places.size(), 1u);
    const RayInvariants ray = invariants(ray_at(at, delta));
    const double b = ray.angular_momentum / ray.energy;
    ASSERT_GT(ray.radial, 0);
    const auto slowness = [b](double r) {
      const double f = 1 - 2 / r;
      return 1 / (f * std::sqrt(1 - f * b * b / (r * r)));
    };
    const double time = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        slowness, places[0].r, at, 14, 1e-12);
    EXPECT_NEAR(places[0].delay,
                time + Schwarzschild::tortoise(at) - Schwarzschild::tortoise(places[0].r), 1e-8)
        << places[0].r;
  }
}

// The observer's own times of both frames differ by 2 r*.
TEST(ReferenceDisc, CountsTheSameTimeFromBothFrames) {
  const double at = 12, s = std::sqrt(2 / at);
  const Vector3 normal{0.6, 0.8, 0};
  // At rest against the hole in both.
  const double own = s / std::sqrt(1 - s * s);
  const ReferenceDiscView falling{at, false, {own, 0, 0}, normal, 2, 40, true};
  const ReferenceDiscView rising{at, true, {-own, 0, 0}, normal, 2, 40, true};
  const Vector3 direction{-0.9, -0.3, std::sqrt(0.1)};
  const auto a = reference_disc(falling, direction), b = reference_disc(rising, direction);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GE(a.size(), 1u);
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double loose = 1e-9 * std::exp(kPi * a[k].order);
    EXPECT_NEAR(a[k].r, b[k].r, loose * a[k].r);
    EXPECT_NEAR(a[k].one_plus_z, b[k].one_plus_z, loose);
    EXPECT_NEAR(a[k].azimuth, b[k].azimuth, loose);
    EXPECT_NEAR(a[k].delay, b[k].delay + 2 * Schwarzschild::tortoise(at), 100 * loose);
  }
}

}  // namespace
}  // namespace domefall
