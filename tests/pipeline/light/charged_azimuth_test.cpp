#include "pipeline/light/charged_azimuth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/pipeline/light/charged_rays.h"

namespace domefall {
namespace {

ChargedRay ray_of(const ChargedView& view, const ChargedReference& row) {
  if (row.edge.empty()) return view.ray_at(polar_angle(row.delta));
  const Critical edge = row.edge == "silhouette" ? Critical::kFirst : Critical::kSecond;
  return view.ray_off_edge(edge, static_cast<double>(row.offset));
}

std::string name_of(ChargedOrigin origin, bool naked) {
  switch (origin) {
    case ChargedOrigin::kOwn:
      return "I,";
    case ChargedOrigin::kParallel:
      return "III,";
    case ChargedOrigin::kBefore:
      return "H,E";
    case ChargedOrigin::kParallelBefore:
      return "none";
    case ChargedOrigin::kDark:
      break;
  }
  return naked ? "B," : "H,B";
}

TEST(ChargedReferenceRows, HaveTheRightOriginAndAzimuth) {
  const std::vector<ChargedReference> rows = charged_references();
  ASSERT_EQ(rows.size(), 361);
  double worst = 0;
  for (const ChargedReference& row : rows) {
    const ChargedHole hole(1, row.charge);
    const ChargedView view(hole, hole.at(row.r));
    const ChargedRay ray = ray_of(view, row);
    ASSERT_EQ(name_of(view.origin_of(ray), hole.is_naked()), row.origin + "," + row.beyond)
        << row.line;
    EXPECT_NEAR(std::abs(static_cast<double>(view.energy(ray))), row.one_plus_z,
                1e-12 * row.one_plus_z)
        << row.line;
    if (row.mino == 0) continue;
    const double phi = row.mino * std::sqrt(row.k), error = std::abs(view.azimuth(ray) - phi);
    worst = std::max(worst, error / std::max(1.0, phi));
    EXPECT_LT(error, 2e-11) << row.line;
  }
  RecordProperty("worst", std::to_string(worst));
}

// ---- an independent way: quadrature over w itself with 50 digits ----

using Digits50 = boost::multiprecision::cpp_bin_float_50;

struct QuadratureRay {
  Digits50 q2, b, w;
  bool outward;  // back in time

  Digits50 p(const Digits50& at) const { return 1 / (b * b) - at * at * (1 - at * (2 - q2 * at)); }
  // Returns the next root of P above w, where it changes its sign.
  Digits50 turn() const {
    Digits50 low = w, high = w;
    while (p(high) > 0) {
      low = high;
      high *= 1.003;
    }
    for (int k = 0; k < 170; ++k) (p((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return low;
  }
  bool reaches_sky(const Digits50& from) const {
    for (int k = 1; k < 2000; ++k)
      if (p(from * k / 2000) <= 0) return false;
    return true;
  }
};

// With w = w_t - (w_t - low) y^2 the root at the turning point is gone.
double quadrature(const QuadratureRay& ray) {
  boost::math::quadrature::tanh_sinh<Digits50> integrator(9);
  const auto leg = [&](const Digits50& low, const Digits50& high) {
    return integrator.integrate(
        [&](const Digits50& y) {
          const Digits50 value = ray.p(high - (high - low) * y * y);
          return value > 0 ? Digits50(2 * (high - low) * y / sqrt(value)) : Digits50(0);
        },
        Digits50(0), Digits50(1), Digits50(1e-10));
  };
  if (ray.outward) return static_cast<double>(leg(0, ray.w));
  const Digits50 turn = ray.turn();
  return static_cast<double>(leg(0, turn) + leg(ray.w, turn));
}

TEST(ChargedView, AgreesWithQuadratureAlongRandomRays) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit;
  const double charges[] = {0.05, 0.3, 0.7, 0.95, 0.9999, 1, 1.01, 1.05, 1.07, 1.3, 3};
  int skies = 0, dark = 0;
  double worst = 0;
  for (int k = 0; k < 44; ++k) {
    const double q = charges[k % 11], inner = q < 1 ? q * q / 2 : 1;
    const double r = inner * std::pow(30 / inner, 1.2 * unit(random) - 0.2);
    const double alpha = std::numbers::pi * unit(random);
    const bool outgoing = unit(random) < 0.5;
    const ChargedHole hole(1, q);
    const ChargedView view(hole, hole.at(r), outgoing);
    const ChargedRay ray = view.ray_at(polar_angle(alpha));
    const Digits50 w = 1 / Digits50(r), q2 = Digits50(q) * q, f = 1 - w * (2 - q2 * w);
    const Digits50 s = sin(Digits50(alpha) / 2), c = cos(Digits50(alpha) / 2);
    const Digits50 e = s * s + f * c * c;
    const Digits50 rate = outgoing ? Digits50(s * s - f * c * c) : Digits50(f * c * c - s * s);
    const QuadratureRay slow{q2, 2 * r * s * c / abs(e), w, rate < 0};
    const bool from_sky = slow.reaches_sky(slow.outward ? w : slow.turn());
    ASSERT_EQ(view.origin_of(ray) != ChargedOrigin::kDark, from_sky)
        << q << " " << r << " " << alpha;
    ++(from_sky ? skies : dark);
    if (!from_sky) continue;
    const double phi = quadrature(slow), error = std::abs(view.azimuth(ray) - phi);
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-13 * std::max(1.0, phi))
        << q << " " << r << " " << alpha << " " << outgoing;
  }
  EXPECT_GT(skies, 30);
  EXPECT_GT(dark, 0);
  RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace domefall
