// What must hold of all rays about a spin together.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/light/kerr_ray.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The part of the view beyond s_0 = ln((delta - edge)/(end - edge)), for all eta, is a disc.  What it
// covers of the sky, mirror images counted as negative, and what the image of its rim runs around
// differ by whole spheres n, which are as many as images of the southern pole are in it:
//
//     integral of sky.(d sky/d delta x d sky/d eta) d delta d eta
//         = 4 pi n -+ integral of (x dy - y dx)/(1 + z) along the rim
//
// since (x dy - y dx)/(1 + z) is a potential of the sphere's area but for that pole.  This is returned as n.
double whole_spheres(const KerrPlace& at, KerrEdge sky, double s0) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  constexpr int kEtas = 400;
  const int panels = static_cast<int>(std::ceil(-s0 / 1.5));
  const double end = sky == KerrEdge::kSilhouette ? pi : 0;
  double area = 0, rim = 0;
  for (int k = 0; k < kEtas; ++k) {
    const double eta = 2 * pi * k / kEtas;
    const auto edge = [&](double by) {
      return static_cast<double>(critical_ray(at, eta + by, sky).delta);
    };
    const double from = edge(0), h = 1e-3;
    const auto ray = [&](double s) {
      return trace_kerr(at, {0, eta, sky, std::exp(s) * (end - from)});
    };
    const auto sine = [&](double s) { return std::sin(from + std::exp(s) * (end - from)); };
    for (int panel = 0; panel < panels; ++panel)
      for (std::size_t i = 0; i < 2 * Rule::abscissa().size(); ++i) {
        const double x = Rule::abscissa()[i / 2] * (i % 2 == 0 ? 1 : -1);
        const double s = s0 * (panel + (1 + x) / 2) / panels;
        const TracedKerr there = ray(s);
        area += Rule::weights()[i / 2] / 2 * std::abs(s0) / panels * std::exp(s) *
                std::abs(end - from) * sine(s) * there.sky.dot(there.by_delta.cross(there.across));
      }
    // Along the rim both delta and eta change.
    const double slope = (8 * (edge(h) - edge(-h)) - (edge(2 * h) - edge(-2 * h))) / (12 * h);
    const TracedKerr there = ray(s0);
    const V3d by = there.by_delta * (slope * (1 - std::exp(s0))) + there.across * sine(s0);
    rim += (there.sky.x * by.y - there.sky.y * by.x) / (1 + there.sky.z);
  }
  const double width = 2 * pi / kEtas;
  return (area + (sky == KerrEdge::kSilhouette ? rim : -rim)) * width / (4 * pi);
}

TEST(KerrSkies, AreCoveredWholeTimes) {
  for (const KerrPlace& at :
       {KerrPlace{{0.5L}, 10, 1.2L}, KerrPlace{{0.9L}, 6, 0.4L}, KerrPlace{{0.9L}, 1.6L, 2.0L},
        KerrPlace{{0.3L, 0.8L}, 3, 1.5L}, KerrPlace{{0.9L}, 1.1L, 1.2L}})
    for (const double s0 : {-1.0, -5.0})
      for (const KerrEdge sky : {KerrEdge::kSilhouette, KerrEdge::kRegionThree}) {
        if (sky == KerrEdge::kRegionThree && at.delta() > 0) continue;
        const double n = whole_spheres(at, sky, s0);
        EXPECT_NEAR(n, std::round(n), 1e-6) << s0;
        EXPECT_LE(std::abs(n), 1 + 1e-6);  // images follow each other in both senses
      }
}

// By how much light that circles at r = x parts from there while its latitude goes once to and fro half
// way: gamma = sqrt((r'^2)''/2) times that half period of Mino's time.
double lyapunov(const KerrPlace& at, double eta) {
  const CriticalRay edge = critical_ray(at, eta, KerrEdge::kSilhouette);
  // With E = 1: K, L - a, and u'^2 = Q - (K + 2 a (L - a)) u^2 - a^2 u^4 for u = cos(theta)
  const auto a = static_cast<double>(at.hole.spin), x = static_cast<double>(edge.x);
  const auto gap = static_cast<double>(at.hole.delta(edge.x));
  const double k = std::pow(2 * x * std::sqrt(gap) / (x - 1), 2);
  const double p = 2 * x * gap / (x - 1), less = (x * x - p) / a;  // L - a
  const double q = k - less * less, b = k + 2 * a * less;
  const double top = 2 * q / (b + std::sqrt(b * b + 4 * a * a * q));
  constexpr int kNodes = 200;
  double half = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double sine = std::sin(pi * (i + 0.5) / kNodes - pi / 2);
    half += pi / kNodes / std::sqrt(q / top + a * a * top * sine * sine);
  }
  // (r'^2)'' = 8 r^2 + 4 P - 2 K
  return half * std::sqrt((8 * x * x + 4 * p - 2 * k) / 2);
}

// Where the latitude has turned once more, as delta - edge.
double turns_from(const KerrPlace& at, double eta, int turns) {
  double low = 1e-18, high = 0.3;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    const TracedKerr ray = trace_kerr_without_area(at, {0, eta, KerrEdge::kSilhouette, middle});
    (ray.turns >= turns ? low : high) = middle;
  }
  return low;
}

// From one turn of the latitude to the next, half a turn is swept.
TEST(KerrRay, SweepsHalfTurnsOfTheLatitude) {
  for (const long double spin : {1e-3L, 0.5L, 0.998L})
    for (const double eta : {0.3, 1.2, 2.4, -0.8, -1.4}) {
      const KerrPlace at{{spin}, 10, 1.3L};
      const auto swept = [&](int turns) {
        const double offset = turns_from(at, eta, turns);
        return trace_kerr_without_area(at, {0, eta, KerrEdge::kSilhouette, offset}).swept;
      };
      EXPECT_NEAR(swept(10) - swept(9), pi, 1e-6) << spin << " " << eta;
      EXPECT_NEAR(swept(9) - swept(6), 3 * pi, 0.02) << spin << " " << eta;
    }
}

// The images between one turn of the latitude and the next are a band along the edge.
TEST(KerrEdge, ImagesThinOutByTheExponentOfLightThatCircles) {
  for (const long double spin : {0.5L, 0.9L, 0.998L})
    for (const double eta : {0.3, 1.2, 2.4, -0.8, -1.4, -2.6}) {
      const KerrPlace at{{spin}, 10, 1.3L};
      const double one = turns_from(at, eta, 8), two = turns_from(at, eta, 9),
                   three = turns_from(at, eta, 10);
      const double ratio = (two - three) / (one - two);
      EXPECT_NEAR(ratio / std::exp(-lyapunov(at, eta)), 1, 0.01) << spin << " " << eta;
    }
}

}  // namespace
}  // namespace domefall
