// Charts of the skies near a hole that spins, the lens that they make, and images of points.
#include "pipeline/light/kerr_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/light/kerr_points.h"
#include "pipeline/light/lens_store.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct SpinPlace {
  double spin, charge, r, theta;
  bool third = false;

  KerrPlace at() const { return {{spin, charge}, r, theta}; }
  KerrEdge edge() const { return third ? KerrEdge::kRegionThree : KerrEdge::kSilhouette; }

  // An observer there, about an axis that points to z.
  ObserverState observer() const {
    ObserverState o;
    o.spacetime = SpinningHole{1, {spin, charge}};
    o.r = r;
    o.region = r > o.spacetime.horizon() ? Region::kI : Region::kII;
    const double s = std::sin(theta), c = std::cos(theta);
    o.sky_from_tetrad = from_columns({s, 0, c}, {c, 0, -s}, {0, 1, 0});
    return o;
  }
};

std::vector<SpinPlace> places() {
  return {{0.9, 0, 10, 1.2}, {0.9, 0, 1.6, 1.2}, {0.5, 0, 6, 1e-3},      {0.9, 0, 6, 0},
          {0.5, 0.7, 20, 2}, {0.9, 0, 1, 1.2},   {0.9, 0, 1, 1.2, true}, {0.998, 0, 6, pi / 2}};
}

// Direction of view that looks opposite to the photon.
V3d view(double delta, double eta) {
  const double s = std::sin(delta);
  return {-std::cos(delta), -s * std::cos(eta), -s * std::sin(eta)};
}

// Places and derivatives of the chart are those of exact rays.
TEST(KerrChart, IsTheExactRays) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const SpinPlace& place : places()) {
    if (kSanitized && place.charge == 0) continue;
    const KerrChart chart(place.at(), place.edge());
    int compared = 0;
    for (int k = 0; k < tries(200, 40); ++k) {
      const double eta = 2 * pi * part(random);
      const KerrChart::Edge edge = chart.edge(eta);
      EXPECT_NEAR(edge.delta,
                  static_cast<double>(critical_ray(place.at(), eta, place.edge()).delta),
                  place.spin > 0.99 ? 2e-6 : 1e-9);
      // Half of them are close to the edge.
      const double away = k % 2 == 0 ? part(random) : std::exp(-13 * part(random));
      const double delta = edge.delta + away * (chart.end() - edge.delta);
      const KerrChart::Place at = chart.place(delta, eta, edge);
      const TracedKerr exact = trace_kerr(place.at(), {delta, eta});
      if (exact.origin == KerrOrigin::kPastHorizon) continue;  // by the edge's rounding
      ++compared;
      EXPECT_LT((at.sky - exact.sky).length(), 2e-5) << place.spin << " " << delta << " " << eta;
      const double size = exact.by_delta.length() + exact.across.length();
      EXPECT_LT((at.by_delta - exact.by_delta).length() + (at.across - exact.across).length(),
                2e-3 * size)
          << place.spin << " " << delta << " " << eta;
      EXPECT_NEAR(kerr_frequency_ratio(place.at(), delta, eta) * std::abs(exact.energy), 1, 1e-9);
    }
    EXPECT_GT(compared, tries(160, 30));
  }
}

TEST(KerrLens, HasTheSameRaysInBatchesAndAlone) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const SpinPlace& place : {places()[0], places()[5]}) {
    const auto lens = LensStore().lens(place.observer(), {{true, true, false, false}});
    DirectionBatch n{};
    for (std::size_t k = 0; k < DirectionBatch::kSize; ++k) {
      const V3d d = V3d(normal(random), normal(random), normal(random)).normalized();
      n.x[k] = d.x, n.y[k] = d.y, n.z[k] = d.z;
    }
    ViewRayBatch batch{};
    lens->rays(n, DirectionBatch::kSize, batch);
    int skies = 0;
    for (std::size_t k = 0; k < DirectionBatch::kSize; ++k) {
      const ViewRay ray = lens->ray({n.x[k], n.y[k], n.z[k]});
      ASSERT_EQ(batch.sky[k], ray.sky);
      EXPECT_NEAR(batch.to_edge[k], ray.to_edge, 1e-12);
      if (!ray.known) continue;
      ++skies;
      const auto i = static_cast<int>(k);
      EXPECT_LT((batch.sky_direction(i) - ray.sky_direction).length(), 2e-5);
      EXPECT_NEAR(batch.longer(i) / ray.longer(), 1, 1e-3);
      EXPECT_NEAR(batch.shorter(i), ray.shorter(), 1e-3 * ray.longer());
      // A small step in the view moves the place as the derivative says.
      const V3d d{n.x[k], n.y[k], n.z[k]}, by = ray.axis * 1e-6;
      if (ray.to_edge < 1e-3) continue;
      const ViewRay beside = lens->ray((d + by).normalized());
      EXPECT_LT((beside.sky_direction - ray.sky_direction - ray.moved(d, by)).length(),
                1e-9 * (1 + ray.longer() * ray.longer() * ray.longer()));
      const V3d other = d.cross(ray.axis) * 1e-6;
      const ViewRay next = lens->ray((d + other).normalized());
      EXPECT_LT((next.sky_direction - ray.sky_direction - ray.moved(d, other)).length(),
                1e-9 * (1 + ray.longer() * ray.longer() * ray.longer()));
    }
    EXPECT_GT(skies, 60);
  }
}

// Without spin it is Schwarzschild's lens.
TEST(KerrLens, OfLittleSpinIsThatOfNone) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const double r : {30.0, 6.0, 2.5}) {
    SpinPlace place{1e-9, 0, r, 1.3};
    ObserverState o = place.observer();
    const auto spinning = LensStore().lens(o, {});
    o.spacetime = ChargedHole(1, 1e-12);
    const auto still = LensStore().lens(o, {});
    for (int k = 0; k < 200; ++k) {
      const V3d d = V3d(normal(random), normal(random), normal(random)).normalized();
      const ViewRay a = spinning->ray(d), b = still->ray(d);
      ASSERT_EQ(a.sky, b.sky);
      if (b.to_edge < 0.1) {
        EXPECT_NEAR(a.to_edge, b.to_edge, 1e-8 + 0.01 * b.to_edge);
      }
      if (!a.known) continue;
      EXPECT_LT((a.sky_direction - b.sky_direction).length(), 1e-7 * (1 + b.longer()));
      EXPECT_NEAR(a.frequency_ratio, b.frequency_ratio, 1e-8);
      EXPECT_NEAR(a.longer() / b.longer(), 1, 1e-6);
      EXPECT_NEAR(a.shorter(), b.shorter(), 1e-6 * b.longer());
      EXPECT_EQ(a.mirrored, b.mirrored);
    }
  }
}

// Whatever direction light comes from, its image is found there.
TEST(KerrPoints, AreSeenWhereTheirLightComesFrom) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(0, 1);
  for (const SpinPlace& place : places()) {
    if (place.spin > 0.99 || (kSanitized && place.charge == 0)) continue;
    const KerrChart chart(place.at(), place.edge());
    const double s = std::sin(place.theta), c = std::cos(place.theta);
    const KerrPoints points(chart, s, c);
    int found = 0, missed = 0;
    std::vector<double> off;
    for (int k = 0; k < tries(100, 40); ++k) {
      const double eta = 2 * pi * part(random), from = chart.edge(eta).delta;
      const double away = k % 2 == 0 ? part(random) : std::exp(-8 * part(random));
      const double delta = from + away * (chart.end() - from);
      const TracedKerr ray = trace_kerr(place.at(), {delta, eta});
      if (ray.origin == KerrOrigin::kPastHorizon) continue;
      const V3d& sky = ray.sky;
      const V3d source(sky.x * s + sky.z * c, sky.x * c - sky.z * s, sky.y);
      std::vector<SkyImage> images;
      points.list_images(source, 0, 0, images);
      const V3d n = view(delta, eta);
      const auto image = std::ranges::find_if(images, [&](const SkyImage& one) {
        return (one.direction.v - n).length() < 1e-5 + 1e-4 * ray.amplification;
      });
      ++(image == images.end() ? missed : found);
      if (image == images.end() || ray.amplification > 30) continue;
      EXPECT_NEAR(image->amplification / ray.amplification, 1, place.third ? 2e-2 : 5e-3)
          << place.spin << " " << delta << " " << eta;
      EXPECT_NEAR(image->frequency_ratio * std::abs(ray.energy), 1, 1e-4);
      // All other images are right, too.
      for (const SkyImage& one : images) {
        const V3d& m = one.direction.v;
        const TracedKerr back = trace_kerr_without_area(
            place.at(), {std::atan2(std::hypot(m.y, m.z), -m.x), std::atan2(-m.z, -m.y)});
        off.push_back((back.sky - sky).length());
      }
    }
    EXPECT_GT(found, tries(75, 25));
    std::sort(off.begin(), off.end());
    EXPECT_LT(off[off.size() * 97 / 100], 1e-5)
        << place.spin << " " << place.r << " " << place.third;
    EXPECT_LT(off.back(), 1e-2);
    // Between the horizons images are missed where the chart is rough, next to the edge.
    EXPECT_LE(missed, place.r > 1 ? 1 : found / 10)
        << place.spin << " " << place.r << " " << place.third;
  }
}

TEST(KerrLens, AimsAtThePrimaryImage) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (const SpinPlace& place : {places()[0], places()[2], places()[4]}) {
    const ObserverState o = place.observer();
    const auto lens = LensStore().lens(o, {{false, false, false, false}});
    const auto known = LensStore().lens(o, {{true, false, false, false}});
    for (int k = 0; k < tries(40, 6); ++k) {
      const V3d source = V3d(normal(random), normal(random), normal(random)).normalized();
      const ViewRay ray = known->ray(lens->primary_image(source));
      ASSERT_TRUE(ray.known);
      EXPECT_LT((ray.sky_direction - apply(o.sky_from_tetrad, source)).length(), 1e-9) << k;
    }
  }
}

// The silhouette of an observer far away, Bardeen's curve.
TEST(KerrLens, HasBardeensSilhouette) {
  for (const double spin : {0.3, 0.7, 0.94, 0.998, 0.999999})
    for (const double theta : {0.3, 1.0, pi / 2}) {
      const double r = 1e8;
      const SpinPlace place{spin, 0, r, theta};
      for (int k = 0; k < 64; ++k) {
        const double eta = 2 * pi * (k + 0.5) / 64;
        const CriticalRay ray = critical_ray(place.at(), eta, KerrEdge::kSilhouette);
        // By the radius of the light that circles: Bardeen, Press & Teukolsky, ApJ 178, 347 (1972).
        const auto x = static_cast<double>(ray.x), a = spin;
        const double xi = -(x * x * x - 3 * x * x + a * a * (x + 1)) / (a * (x - 1));
        const double carter =
            x * x * x * (4 * a * a - x * (x - 3) * (x - 3)) / (a * a * (x - 1) * (x - 1));
        const double alpha = -xi / std::sin(theta);
        const double beta2 = carter + a * a * std::cos(theta) * std::cos(theta) -
                             xi * xi / (std::tan(theta) * std::tan(theta));
        const double size = r * std::sin(static_cast<double>(ray.delta));
        const double own = -(size * std::sin(eta) + a * std::sin(theta));
        const double scale = spin > 0.99 ? 2e-4 : 1e-6;
        EXPECT_NEAR(own, alpha, scale) << spin << " " << theta << " " << eta;
        EXPECT_NEAR(size * size * std::cos(eta) * std::cos(eta), beta2, 20 * scale);
      }
    }
}

}  // namespace
}  // namespace domefall
