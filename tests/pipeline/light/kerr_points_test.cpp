// Images of points about a hole that spins.
#include "pipeline/light/kerr_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "pipeline/light/kerr_view.h"
#include "tests/pipeline/light/spin_places.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Whatever direction light comes from, its image is found there.
TEST(KerrPoints, AreSeenWhereTheirLightComesFrom) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(0, 1);
  for (const SpinPlace& place : spin_places()) {
    if (kSanitized && place.charge == 0) continue;
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
      const V3d n = kerr_view(delta, eta);
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

// A direction of view, and the part of a star's light that comes from there.
struct FoundImage {
  double way, eta, light;  // way: delta, from the silhouette's edge

  FoundImage(const KerrPlace& at, const KerrDirection& towards, double amplification)
      : way(static_cast<double>(towards.delta) -
            kerr_edge_delta(at, static_cast<double>(towards.eta))),
        eta(static_cast<double>(towards.eta)),
        light(amplification) {}

  // Images crowd towards the edge.
  bool is(const FoundImage& other) const {
    return std::abs(way - other.way) < 0.02 * way &&
           std::abs(std::remainder(eta - other.eta, 2 * pi)) < 5e-3;
  }
};

bool is_among(const std::vector<FoundImage>& images, const FoundImage& image) {
  return std::ranges::any_of(images, [&](const FoundImage& other) { return image.is(other); });
}

// Returns the image of a star that Newton's method comes to by exact rays.
std::optional<FoundImage> exact_image(const KerrPlace& at, const V3d& star, double delta,
                                      double eta) {
  for (int i = 0; i < 30; ++i) {
    const TracedKerr ray = trace_kerr(at, {delta, eta});
    if (ray.origin == KerrOrigin::kPastHorizon) return std::nullopt;
    const V3d off = star - ray.sky, normal = ray.by_delta.cross(ray.across);
    const double det = normal.dot(ray.sky);
    const double by_delta = off.cross(ray.across).dot(ray.sky) / det;
    const double by_eta = ray.by_delta.cross(off).dot(ray.sky) / det / std::sin(delta);
    if (std::hypot(by_delta, by_eta) < 1e-11)
      return FoundImage(at, {delta, eta}, ray.amplification);
    const double slow = std::min(1.0, 0.1 / std::hypot(by_delta, by_eta));
    delta += slow * by_delta, eta += slow * by_eta;
    if (!(delta > 0 && delta < pi)) return std::nullopt;
  }
  return std::nullopt;
}

// Brute force: a net of exact rays over the view, each triangle of which holds an image of what is within
// its place on the sky, found to the last digit by Newton's method.  Triangles that are too large to tell
// may miss images next to the flat side of a hole that spins nearly as fast as it can.
class ImagesByForce {
 public:
  explicit ImagesByForce(const KerrPlace& at) : at_(at) {
    for (int row = 0; row <= kRows; ++row)
      for (int column = 0; column <= kColumns; ++column)
        net_.push_back(trace_kerr_without_area(at_, direction(row, column)).sky);
  }

  std::vector<FoundImage> images(const V3d& star) const {
    std::vector<FoundImage> images;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const V3d &a = net(row, column), &b = net(row + 1, column), &c = net(row, column + 1),
                  &d = net(row + 1, column + 1);
        const double reach = std::max((a - d).length2(), (b - c).length2());
        if ((a - star).length2() > 4 * reach || reach > 1) continue;
        if (!holds(a, b, c, star) && !holds(b, d, c, star)) continue;
        const auto towards = direction(row + 0.5, column + 0.5);
        const auto image = exact_image(at_, star, static_cast<double>(kerr_delta(at_, towards)),
                                       static_cast<double>(towards.eta));
        if (image && !is_among(images, *image)) images.push_back(*image);
      }
    return images;
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
  KerrPlace at_;
  std::vector<V3d> net_;
};

TEST(KerrPoints, HaveTheLightOfBruteForce) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(0, 1);
  int stars = 0, bright = 0;
  double worst = 0;
  for (const SpinPlace& place : {spin_places()[0], spin_places()[4], spin_places()[7]}) {
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
      std::vector<SkyImage> listed;
      points.list_images(V3d(sky.x * s + sky.z * c, sky.x * c - sky.z * s, sky.y), 0, 0, listed);
      std::vector<FoundImage> images;
      double light = 0, wrong = 0;
      for (const SkyImage& image : listed) {
        const KerrDirection towards = kerr_direction_of(image.direction.v);
        const FoundImage ours(place.at(), towards, image.amplification);
        const auto exact = exact_image(place.at(), sky, static_cast<double>(towards.delta),
                                       static_cast<double>(towards.eta));
        if (exact && !is_among(images, *exact)) {
          light += exact->light, wrong += std::abs(ours.light - exact->light);
          images.push_back(*exact);
          EXPECT_TRUE(ours.light < 1e-2 || ours.is(*exact));
        } else {
          wrong += ours.light;  // no image, or one twice
        }
      }
      for (const FoundImage& image : force.images(sky))
        if (!is_among(images, image)) light += image.light, wrong += image.light;
      ++stars, bright += light > 10;
      EXPECT_LT(wrong / light, 1e-3)
          << place.spin << " " << place.r << " star " << k << " light " << light;
      worst = std::max(worst, wrong / light);
    }
  }
  std::cout << stars << " stars, " << bright << " of them brighter than tenfold, of worst light "
            << worst << "\n";
}

}  // namespace
}  // namespace domefall
