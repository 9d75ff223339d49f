#include "pipeline/light/kerr_ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pipeline/light/kerr_sphere.h"
#include "pipeline/light/traced_charge.h"
#include "pipeline/spacetime/charged.h"
#include "tests/pipeline/light/kerr_rays.h"
#include "tests/pipeline/light/kerr_schild.h"

namespace domefall {
namespace {

using std::numbers::pi;

double off(double value, double exact) { return std::abs(value / exact - 1); }

V3d turned(const V3d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {v.x * c - v.y * s, v.x * s + v.y * c, v.z};
}

TEST(KerrRay, IsThatOfTheReference) {
  const std::vector<KerrReference> rows = kerr_references("kerr_rays.csv");
  ASSERT_GT(rows.size(), 400U);
  for (const KerrReference& row : rows) {
    SCOPED_TRACE(row.line);
    const TracedKerr ray = trace_kerr(row.at(), row.direction());
    const std::string origin = ray.origin == KerrOrigin::kOwn        ? "I"
                               : ray.origin == KerrOrigin::kParallel ? "III"
                                                                     : "H";
    ASSERT_EQ(origin, row.text("origin"));
    EXPECT_LT(off(ray.energy, row.number("energy")), 2e-15);
    if (origin == "H") continue;
    const V3d place(row.number("x"), row.number("y"), row.number("z"));
    const bool near = row.has("offset") && std::abs(row.number("offset")) <= 1e-6;
    EXPECT_LT((ray.sky - place).length(), near ? 3e-12 : 3e-14);
    EXPECT_LT(off(ray.amplification, row.number("amplification")), near ? 2e-11 : 1e-12);
    EXPECT_LT(off(ray.mino, row.number("mino")), 5e-15);
    EXPECT_EQ(ray.turns, std::stoi(row.text("turns")));
    const TracedKerr quick = trace_kerr_without_area(row.at(), row.direction());
    EXPECT_LT((ray.sky - quick.sky).length(), 1e-11);
  }
}

TEST(KerrRay, PassesTheEquatorAsTheReference) {
  const std::vector<KerrReference> rows = kerr_references("kerr_disc.csv");
  ASSERT_GT(rows.size(), 150U);
  for (const KerrReference& row : rows) {
    SCOPED_TRACE(row.line);
    const KerrPlace at = row.at();
    const std::vector<KerrPassage> passages = kerr_passages(at, row.direction());
    const auto k = static_cast<std::size_t>(std::stoi(row.text("k")));
    ASSERT_LT(k, passages.size());
    const KerrPassage& there = passages[k];
    EXPECT_LT(off(there.r, row.number("r_there")), 1e-13);
    EXPECT_LT(std::abs(std::remainder(there.phi - row.number("phi_there"), 2 * pi)), 2e-14);
    EXPECT_NEAR(there.null_time, row.number("null_time"), 1e-11);
    EXPECT_EQ(there.outgoing, row.text("outgoing") == "1");
    for (const std::string sense : {"pro", "retro"}) {
      const std::optional<double> shift = circling_shift(at.hole, there, sense == "pro");
      ASSERT_EQ(shift.has_value(), row.has("shift_" + sense));
      if (shift) {
        EXPECT_LT(off(*shift, row.number("shift_" + sense)), 5e-13);
      }
      if (!row.has("flux_" + sense)) continue;
      const double flux = page_thorne_flux(at.hole, there.r, sense == "pro");
      EXPECT_NEAR(flux, row.number("flux_" + sense), 5e-13 * row.number("flux_" + sense));
    }
  }
}

TEST(KerrRay, WithoutSpinIsThatOfACharge) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    const double q = i % 3 == 0 ? 0 : unit(random), theta = pi * unit(random);
    const double outer = 1 + std::sqrt(1 - q * q), inner = q * q / outer;
    const double r = i % 4 == 0 ? inner + (outer - inner) * (0.1 + 0.8 * unit(random))
                                : outer * std::pow(10, 0.01 + 3 * unit(random));
    const double delta = pi * unit(random), eta = 2 * pi * unit(random);
    const TracedCharge charged = trace_charge(charged_ray_at_angle(q, r, delta));
    const TracedKerr ray = trace_kerr({{0, q}, r, theta}, {delta, eta, {}, 0});
    SCOPED_TRACE(std::to_string(q) + " " + std::to_string(r) + " " + std::to_string(delta));
    if (charged.origin != ChargedOrigin::kOwn && charged.origin != ChargedOrigin::kParallel) {
      EXPECT_EQ(ray.origin, KerrOrigin::kPastHorizon);
      continue;
    }
    EXPECT_EQ(ray.origin == KerrOrigin::kOwn, charged.origin == ChargedOrigin::kOwn);
    const V3d n(std::sin(theta), 0, std::cos(theta));
    const V3d e(std::cos(eta) * n.z, std::sin(eta), -std::cos(eta) * n.x);
    const V3d place = n * std::cos(charged.phi) - e * std::sin(charged.phi);
    EXPECT_LT((ray.sky - place).length(), 1e-13 * (1 + std::abs(charged.slope)));
    EXPECT_LT(off(ray.energy, charged.energy), 1e-13);
    EXPECT_LT(off(ray.swept, charged.phi), 1e-13 * (1 + std::abs(charged.slope)));
    EXPECT_LT(off(ray.amplification, charged.amplification), 1e-6);
  }
}

// A random ray outside the inner horizon.
struct RandomRay {
  KerrPlace at;
  KerrDirection direction;
};

RandomRay random_ray(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double a = 0.99 * unit(random),
               q = unit(random) < 0.5 ? 0 : unit(random) * std::sqrt(0.99 - a * a);
  const double d = std::sqrt(1 - a * a - std::min(q * q, 1 - a * a));
  const bool within = unit(random) < 0.2;
  const double r = within ? 1 + d * (2 * unit(random) - 1) * 0.9
                          : 1 + d * 1.02 + std::pow(10, -2 + 5 * unit(random));
  RandomRay ray{{{a, std::isnan(q) ? 0 : q}, r, std::acos(1 - 2 * unit(random))}, {}};
  ray.direction = {std::acos(1 - 2 * unit(random)), 2 * pi * unit(random), {}, 0};
  if (unit(random) < 0.5) return ray;
  // next to the edge
  const long double edge = critical_ray(ray.at, ray.direction.eta, KerrEdge::kSilhouette).delta;
  const double delta = static_cast<double>(edge) + std::pow(10, -4 + 3 * unit(random));
  if (delta < pi) ray.direction.delta = delta;
  return ray;
}

TEST(KerrRay, IsThatOfHamiltonsEquations) {
  std::mt19937_64 random(2);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const auto [at, direction] = random_ray(random);
    const TracedKerr ray = trace_kerr(at, direction);
    // Between the horizons light of others never reaches these coordinates' r = infinity.
    if (at.delta() < 0 && ray.origin != KerrOrigin::kOwn) continue;
    const auto number = [](long double x) { return static_cast<double>(x); };
    const KerrSchildRay other =
        kerr_schild_ray(number(at.hole.spin), number(at.hole.charge), number(at.r),
                        number(at.theta), number(direction.delta), number(direction.eta));
    EXPECT_EQ(ray.origin == KerrOrigin::kOwn, other.sky);
    EXPECT_NEAR(ray.energy, other.energy, 1e-12 * (1 + std::abs(other.energy)));
    if (!other.sky || ray.origin != KerrOrigin::kOwn) continue;
    ++seen;
    const CriticalRay edge = critical_ray(at, direction.eta, KerrEdge::kSilhouette);
    const double apart = std::min(1.0, number(direction.delta - edge.delta));
    EXPECT_LT((ray.sky - other.place).length(), 1e-9 / apart)
        << number(at.hole.spin) << " " << number(at.r) << " " << number(direction.delta);
  }
  EXPECT_GT(seen, 300);
}

// The direction in which a ray passes the equator, in the tetrad T there.
KerrDirection direction_there(const KerrPlace& at, const KerrStart& start,
                              const KerrPassage& passage, bool rising) {
  const auto a = static_cast<double>(at.hole.spin);
  const double r = passage.r, e = passage.energy, y = passage.angular_momentum - a * e;
  const double k = std::pow(static_cast<double>(start.kappa.v) * e, 2);
  const double gap = static_cast<double>(at.hole.delta(r)), p = r * r * e - a * y;
  const double speed = (passage.outgoing ? 1 : -1) * std::sqrt(p * p - gap * k);
  const double n = passage.outgoing ? (p + speed) / gap : k / (p - speed),
               l = (p - speed) / (2 * r * r);
  const double side = y / r, up = (rising ? -1 : 1) * std::sqrt(std::max(0.0, k - y * y)) / r;
  return {std::atan2(std::hypot(side, up), n / 2 - l), std::atan2(side, up), {}, 0};
}

// With the same E, L and K.
TEST(KerrRay, GoesOnAsItselfFromWhereItPassesTheEquator) {
  std::mt19937_64 random(3);
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    const auto [at, direction] = random_ray(random);
    const TracedKerr ray = trace_kerr(at, direction);
    if (ray.origin != KerrOrigin::kOwn || at.delta() < 0) continue;
    const KerrStart start = kerr_start(at, direction);
    const CriticalRay edge = critical_ray(at, direction.eta, KerrEdge::kSilhouette);
    if (direction.delta - edge.delta < 1e-2L) continue;
    bool rising = std::cos(at.theta) > 0;  // the photon, which comes from the other side
    for (const KerrPassage& passage : kerr_passages(at, direction)) {
      const KerrPlace there{at.hole, passage.r, pi / 2};
      const TracedKerr again = trace_kerr(there, direction_there(at, start, passage, rising));
      rising = !rising;
      if (passage.r > 1e3) continue;  // where directions have lost digits of L
      ++seen;
      EXPECT_EQ(again.origin, ray.origin);
      EXPECT_LT((turned(again.sky, passage.phi) - ray.sky).length(), 1e-9);
    }
  }
  EXPECT_GT(seen, 80);
}

// Whole half turns are taken at once, and the place is that after all of them, with its derivatives.
TEST(KerrRay, GoesOnByHalfTurns) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  double worst = 0, worst_change = 0;
  int turned = 0;
  for (int k = 0; k < 300; ++k) {
    const long double spin = 1 - std::pow(10.0, -6 * part(random));
    const double theta = k % 10 == 0   ? pi / 2
                         : k % 10 == 1 ? 1e-9
                                       : std::acos(1 - 2 * part(random));
    const KerrPlace at{{spin, 0}, 2 + 20 * part(random), theta};
    const double eta = k % 10 == 2 ? pi / 2 : 2 * pi * part(random);
    const KerrStart start = kerr_start(at, {3 * part(random), eta});
    const auto first = kerr_sphere_of<Dual>(start);
    const Dual mino{60 * part(random) / std::abs(static_cast<double>(start.kappa.v)), 0.3, -2};
    KerrSphere<Dual> quick = first, whole = first;
    quick.follow(mino);
    whole.follow(mino.v, false);
    EXPECT_EQ(quick.turns, whole.turns) << k;
    turned += quick.turns;
    for (std::size_t i = 0; i < 3; ++i) {
      const Dual place = whole.place[i] + whole.speed[i] * (mino - mino.v);
      const double size = 1 + std::hypot(place.d, place.e);
      worst = std::max(worst, std::abs(quick.place[i].v - place.v));
      worst_change = std::max({worst_change, std::abs(quick.place[i].d - place.d) / size,
                               std::abs(quick.place[i].e - place.e) / size});
    }
  }
  EXPECT_GT(turned, 1000);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(worst_change, 1e-11);
}

TEST(KerrRay, TurnsWithTheViewOnTheAxis) {
  for (const double a : {0.1, 0.9, 0.999}) {
    const KerrPlace at{{a, 0}, 7, 0};
    const TracedKerr first = trace_kerr(at, {1.3, 0, {}, 0});
    for (const double eta : {0.7, 2.0, -2.5}) {
      const TracedKerr ray = trace_kerr(at, {1.3, eta, {}, 0});
      EXPECT_LT((ray.sky - turned(first.sky, eta)).length(), 1e-14);
      EXPECT_LT(off(ray.amplification, first.amplification), 1e-13);
    }
    // x^3 - 3x^2 + a^2 x + a^2 = 0
    const auto x = static_cast<double>(critical_ray(at, 1, KerrEdge::kSilhouette).x);
    EXPECT_NEAR(((x - 3) * x + a * a) * x + a * a, 0, 1e-13);
  }
}

TEST(KerrEdge, CirclesOnTheEquatorAreKnown) {
  for (const double a : {1e-6, 0.5, 0.998, 0.999999}) {
    const KerrPlace at{{a, 0}, 20, pi / 2};
    for (const double side : {1.0, -1.0}) {
      const double circle = 2 * (1 + std::cos(std::acos(-side * a) * 2 / 3));
      const CriticalRay edge = critical_ray(at, side * pi / 2, KerrEdge::kSilhouette);
      EXPECT_NEAR(static_cast<double>(edge.x), circle, 1e-12);
    }
  }
}

TEST(KerrEdge, IsBetweenTheSkiesAndTheDark) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 300; ++i) {
    const RandomRay ray = random_ray(random);
    const KerrPlace& at = ray.at;
    const KerrDirection& direction = ray.direction;
    const auto origin = [&](KerrEdge edge, double offset) {
      return trace_kerr_without_area(at, {0, direction.eta, edge, offset}).origin;
    };
    const CriticalRay edge = critical_ray(at, direction.eta, KerrEdge::kSilhouette);
    const double small = 1e-9 * static_cast<double>(std::min(
                                    edge.delta, std::numbers::pi_v<long double> - edge.delta));
    EXPECT_EQ(origin(KerrEdge::kSilhouette, small), KerrOrigin::kOwn);
    EXPECT_EQ(origin(KerrEdge::kSilhouette, -small), KerrOrigin::kPastHorizon);
    if (at.delta() >= 0) continue;
    const CriticalRay third = critical_ray(at, direction.eta, KerrEdge::kRegionThree);
    const double little =
        1e-9 * static_cast<double>(std::min(third.delta, edge.delta - third.delta));
    EXPECT_EQ(origin(KerrEdge::kRegionThree, -little), KerrOrigin::kParallel);
    EXPECT_EQ(origin(KerrEdge::kRegionThree, little), KerrOrigin::kPastHorizon);
  }
}

TEST(KerrHole, LastStableCirclesAreKnown) {
  EXPECT_NEAR(last_stable_circle({0, 0}, true), 6, 1e-12);
  EXPECT_NEAR(last_stable_circle({1, 0}, false), 9, 1e-12);
  EXPECT_NEAR(last_stable_circle({0.9L, 0}, true), 2.32088304176189, 1e-12);
  EXPECT_NEAR(last_stable_circle({0, 0.8L}, true), ChargedHole(1, 0.8L).last_stable_orbit(), 1e-12);
}

}  // namespace
}  // namespace domefall
