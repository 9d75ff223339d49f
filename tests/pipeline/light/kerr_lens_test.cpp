// Charts of the skies near a hole that spins, and the lens that they make.
#include "pipeline/light/kerr_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pipeline/light/kerr_request.h"
#include "pipeline/light/lens_store.h"
#include "tests/pipeline/light/spin_places.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Places and derivatives of a chart are those of exact rays, and to a twentieth of a pixel where cells are
// wider for a draft.
class KerrChartStrides : public testing::TestWithParam<int> {};

TEST_P(KerrChartStrides, HaveTheExactRays) {
  const int stride = GetParam();
  const double wider = stride * stride, off = stride == 1 ? 1e-5 : stride == 2 ? 2e-4 : 8e-4;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (const SpinPlace& place : spin_places()) {
    if (kSanitized && (place.charge == 0 || stride == 2)) continue;
    const KerrChart chart(place.at(), place.edge(), stride);
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
      EXPECT_LT((at.sky - exact.sky).length(), off) << place.spin << " " << delta << " " << eta;
      const double size = exact.by_delta.length() + exact.across.length();
      EXPECT_LT((at.by_delta - exact.by_delta).length() + (at.across - exact.across).length(),
                2e-3 * wider * size)
          << place.spin << " " << delta << " " << eta;
      EXPECT_NEAR(chart.frequency_ratio(delta, eta) * std::abs(exact.energy), 1, 1e-9);
    }
    EXPECT_GT(compared, tries(160, 30));
    if (stride > 1) continue;
    int rough = 0;
    for (int row = 0; row < chart.rows(); ++row)
      for (int column = 0; column < chart.columns(); ++column)
        rough += chart.error(row, column) > chart.rough();
    EXPECT_LT(rough, chart.rows() * chart.columns() / 50) << place.spin << " " << place.r;
  }
}
INSTANTIATE_TEST_SUITE_P(Light, KerrChartStrides, testing::Values(1, 2, 4));

TEST(KerrLens, HasTheSameRaysInBatchesAndAlone) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const SpinPlace& place : {spin_places()[0], spin_places()[5]}) {
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

// Without spin it is the lens of a sphere, by its tables, with and without a charge.
TEST(KerrLens, OfLittleSpinIsThatOfNone) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const auto& [r, charge] :
       {std::pair(30.0, 1e-12), {6.0, 1e-12}, {2.5, 1e-12}, {10.0, 0.7}, {2.1, 0.95}}) {
    SpinPlace place{1e-9, charge, r, 1.3};
    ObserverState o = place.observer();
    const auto spinning = LensStore().lens(o, {});
    o.spacetime = ChargedHole(1, charge);
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
      EXPECT_NEAR(a.swept, b.swept, 1e-7 * (1 + b.longer()));
      EXPECT_NEAR(a.longer() / b.longer(), 1, 1e-6);
      EXPECT_NEAR(a.shorter(), b.shorter(), 1e-6 * b.longer());
      EXPECT_EQ(a.mirrored, b.mirrored);
    }
  }
}

TEST(KerrLens, AimsAtThePrimaryImage) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (const SpinPlace& place : {spin_places()[0], spin_places()[2], spin_places()[4]}) {
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

// Next to the horizon sky III is smaller than the end of its chart, where all directions meet.
TEST(KerrChart, HoldsASkyThatIsSmall) {
  for (const double below : {1e-2, 1e-4, 1e-6}) {
    const KerrHole hole{0.9L};
    const KerrPlace at{hole, hole.horizon() - below, 1.2L};
    const KerrChart chart(at, KerrEdge::kRegionThree);
    for (int k = 0; k < tries(300, 30); ++k) {
      const double eta = 2 * pi * k * 0.7548776662466927,
                   part = std::fmod(k * 0.618033988749895, 1);
      const KerrChart::Edge edge = chart.edge(eta);
      const double delta = part * part * edge.delta;
      const KerrChart::Place place = chart.place(delta, eta, edge);
      const TracedKerr exact = trace_kerr(at, {delta, eta});
      if (exact.origin != KerrOrigin::kParallel) continue;
      EXPECT_LT((place.sky - exact.sky).length(), 2e-5) << below << " " << eta << " " << part;
    }
  }
}

// On the ring the image of the sky is turned over, and nowhere farther from the hole.
TEST(KerrLens, HasItsRingWhereImagesTurnOver) {
  for (const SpinPlace& place :
       {spin_places()[0], spin_places()[1], spin_places()[4], SpinPlace{0.99, 0, 20, pi / 2}}) {
    const auto lens = LensStore().lens(place.observer(), {{true, false, false, false}});
    const auto turned_over = [&](double delta, double eta) {
      const TracedKerr ray = trace_kerr(place.at(), {delta, eta});
      return ray.sky.dot(ray.by_delta.cross(ray.across)) > 0;
    };
    const bool first = turned_over(3.1, 0.5);
    const auto corners = std::get<std::vector<V3d>>(lens->einstein_rings().at(0));
    for (std::size_t k = 0; k < corners.size(); k += kSanitized ? 128 : 16) {
      const V3d& n = corners[k];
      const double delta = std::atan2(std::hypot(n.y, n.z), -n.x), eta = std::atan2(-n.z, -n.y);
      EXPECT_EQ(turned_over(delta + 1e-4, eta), first) << place.r << " " << eta;
      EXPECT_NE(turned_over(delta - 1e-4, eta), first) << place.r << " " << eta;
      for (int i = 1; i < 30; ++i)
        ASSERT_EQ(turned_over(std::lerp(delta, pi, i / 30.0), eta), first) << place.r << " " << eta;
    }
  }
}

// Edges are known without tables, and rings of skies with one.
TEST(KerrLens, HasCurvesAsALensOfASphereHas) {
  SpinPlace place{1e-9, 1e-12, 8, 1.3};
  ObserverState o = place.observer();
  const auto spinning = LensStore().lens(o, {{true, false, false, false}}),
             bare = LensStore().lens(o, {{false, false, false, false}});
  o.spacetime = ChargedHole(1, place.charge);
  const auto still = LensStore().lens(o, {{true, false, false, false}});
  EXPECT_TRUE(bare->einstein_rings().empty());
  const auto compare = [](const ViewCurve& curve, const ViewCurve& other) {
    const auto& circle = std::get<ViewCircle>(other);
    for (const V3d& n : std::get<std::vector<V3d>>(curve))
      ASSERT_NEAR(n.dot(circle.axis), circle.cosine, 1e-6);
  };
  compare(bare->borders().at(0).curve, still->borders().at(0).curve);
  compare(spinning->einstein_rings().at(0), still->einstein_rings().at(0));
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
        const long double x = ray.x, h = ray.above_one, a = spin;
        const long double xi = -(x * x * x - 3 * x * x + a * a * (x + 1)) / (a * h);
        const long double carter =
            x * x * x * (4 * a * a - x * (x - 3) * (x - 3)) / (a * a * h * h);
        const long double sine = std::sin(place.at().theta), cosine = std::cos(place.at().theta);
        const long double alpha = -xi / sine;
        const long double beta2 =
            carter + a * a * cosine * cosine - xi * xi * cosine * cosine / (sine * sine);
        // Whatever the distance, sqrt(K)/E is kappa, and L/E = sin(theta) (kappa sin(eta) + a sin(theta)).
        const long double across = ray.kappa * std::sin(static_cast<long double>(eta));
        const long double up = ray.kappa * std::cos(static_cast<long double>(eta));
        EXPECT_NEAR(static_cast<double>(-across - a * sine), static_cast<double>(alpha), 1e-10);
        EXPECT_NEAR(static_cast<double>(up * up), static_cast<double>(beta2), 1e-10);
        // and far away that is r delta.
        const double size = r * std::sin(static_cast<double>(ray.delta));
        EXPECT_NEAR(size, static_cast<double>(ray.kappa), 1e-6) << spin << " " << theta;
      }
    }
}

}  // namespace
}  // namespace domefall
