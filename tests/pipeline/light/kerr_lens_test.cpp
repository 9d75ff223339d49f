// Charts of the skies near a hole that spins, the lens that they make, and images of points.
#include "pipeline/light/kerr_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "pipeline/light/kerr_points.h"
#include "pipeline/light/kerr_request.h"
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
      EXPECT_NEAR(chart.frequency_ratio(delta, eta) * std::abs(exact.energy), 1, 1e-9);
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

// Against brute force: a net of exact rays over the view, each triangle of which holds an image of what is
// within its place on the sky, found to the last digit by Newton's method.
class ImagesByForce {
 public:
  explicit ImagesByForce(const KerrPlace& at) : at_(at) {
    for (int row = 0; row <= kRows; ++row)
      for (int column = 0; column <= kColumns; ++column)
        net_.push_back(trace_kerr_without_area(at_, direction(row, column)).sky);
  }

  // Returns the sum of the images' amplifications.
  double light(const V3d& star) const {
    double sum = 0;
    std::vector<V3d> found;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const V3d &a = net(row, column), &b = net(row + 1, column), &c = net(row, column + 1),
                  &d = net(row + 1, column + 1);
        const double reach = std::max((a - d).length2(), (b - c).length2());
        if ((a - star).length2() > 4 * reach || reach > 1) continue;
        if (holds(a, b, c, star) || holds(b, d, c, star)) sum += image(row, column, star, found);
      }
    return sum;
  }

 private:
  static constexpr int kRows = 260, kColumns = 520;
  static constexpr double kLeast = -13;

  KerrDirection direction(double row, double column) const {
    const double eta = 2 * pi * column / kColumns;
    const auto from = static_cast<double>(critical_ray(at_, eta, KerrEdge::kSilhouette).delta);
    return {0, eta, KerrEdge::kSilhouette, std::exp(kLeast * (1 - row / kRows)) * (pi - from)};
  }
  const V3d& net(int row, int column) const {
    return net_[static_cast<std::size_t>(row * (kColumns + 1) + column)];
  }
  static bool holds(const V3d& a, const V3d& b, const V3d& c, const V3d& p) {
    const double x = a.cross(b).dot(p), y = b.cross(c).dot(p), z = c.cross(a).dot(p);
    return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
  }
  double image(int row, int column, const V3d& star, std::vector<V3d>& found) const {
    double delta = static_cast<double>(kerr_delta(at_, direction(row + 0.5, column + 0.5)));
    double eta = 2 * pi * (column + 0.5) / kColumns;
    for (int i = 0; i < 30; ++i) {
      const TracedKerr ray = trace_kerr(at_, {delta, eta});
      if (ray.origin == KerrOrigin::kPastHorizon) return 0;
      const V3d off = star - ray.sky, normal = ray.by_delta.cross(ray.across);
      const double det = normal.dot(ray.sky);
      const double by_delta = off.cross(ray.across).dot(ray.sky) / det;
      const double by_eta = ray.by_delta.cross(off).dot(ray.sky) / det / std::sin(delta);
      if (std::hypot(by_delta, by_eta) < 1e-11) {
        const V3d n = view(delta, eta);
        for (const V3d& other : found)
          if ((other - n).length() < 1e-9) return 0;
        found.push_back(n);
        return ray.amplification;
      }
      const double slow = std::min(1.0, 0.1 / std::hypot(by_delta, by_eta));
      delta += slow * by_delta, eta += slow * by_eta;
      if (!(delta > 0 && delta < pi)) return 0;
    }
    return 0;
  }

  KerrPlace at_;
  std::vector<V3d> net_;
};

TEST(KerrPoints, HaveTheLightOfBruteForce) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(0, 1);
  int stars = 0, bright = 0;
  for (const SpinPlace& place : {places()[0], places()[4], places()[7]}) {
    const ImagesByForce force(place.at());
    const KerrChart chart(place.at(), KerrEdge::kSilhouette);
    const double s = std::sin(place.theta), c = std::cos(place.theta);
    const KerrPoints points(chart, s, c);
    for (int k = 0; k < tries(66, 6); ++k) {
      V3d sky = V3d(normal(random), normal(random), normal(random)).normalized();
      if (k % 2 == 0) {
        // Next to a caustic, where some image is bright.
        for (int i = 0; i < 100000; ++i) {
          const double eta = 2 * pi * part(random), away = std::exp(-3 * part(random));
          const double from = chart.edge(eta).delta;
          const TracedKerr ray = trace_kerr(place.at(), {from + away * (pi - from), eta});
          sky = ray.sky;
          if (ray.amplification > 5 && ray.amplification < 100) break;
        }
      }
      const double light = force.light(sky);
      std::vector<SkyImage> images;
      points.list_images(V3d(sky.x * s + sky.z * c, sky.x * c - sky.z * s, sky.y), 0, 0, images);
      double sum = 0;
      for (const SkyImage& image : images) {
        sum += image.amplification;
        // Each is one of its own, and the exact ray leads to the star, or close by if it is faint.
        const V3d& n = image.direction.v;
        const TracedKerr ray = trace_kerr(
            place.at(), {std::atan2(std::hypot(n.y, n.z), -n.x), std::atan2(-n.z, -n.y)});
        EXPECT_LT((ray.sky - sky).length(), image.amplification > 1e-2 ? 1e-4 : 0.05)
            << place.spin << " " << place.r << " star " << k;
        EXPECT_EQ(std::ranges::count_if(images,
                                        [&](const SkyImage& other) {
                                          return (other.direction.v - n).length() < 1e-9;
                                        }),
                  1);
      }
      ++stars, bright += light > 10;
      EXPECT_NEAR(sum / light, 1, 1e-3)
          << place.spin << " " << place.r << " star " << k << " light " << light;
    }
  }
  std::cout << stars << " stars, " << bright << " of them brighter than tenfold\n";
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
       {places()[0], places()[1], places()[4], SpinPlace{0.99, 0, 20, pi / 2}}) {
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
