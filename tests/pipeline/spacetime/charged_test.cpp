#include "pipeline/spacetime/charged.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>
#include <numbers>

namespace domefall {
namespace {

// Half of them cancel next to a horizon.
using Digits100 = boost::multiprecision::cpp_bin_float_100;
using std::numbers::sqrt2;

constexpr double kRoundings = 8 * std::numeric_limits<double>::epsilon();
const double kCharges[] = {0,    1e-8, 0.5, 0.8, 0.99, 1 - 1e-12, 1, std::nextafter(1.0, 2.0),
                           1.03, 1.06, 1.1, 2};

// Everything here is what the header says, written out with 100 digits.
struct ExactHole {
  explicit ExactHole(const ChargedHole& hole) : q(1 - Digits100(hole.below_extremal)) {
    if (hole.charge < 0.5) q = hole.charge;
    const Digits100 d2 = (1 - q) * (1 + q);
    d = sqrt(abs(d2));
    outer = 1 + d;
    inner = 1 - d;
    const Digits100 root = 9 - 8 * q * q;
    if (root >= 0) {
      circle = (3 + sqrt(root)) / 2;
      kappa = circle * circle / sqrt(circle - q * q);
      edges = kappa / sqrt(circle) - circle;
    }
  }
  Digits100 delta(const Digits100& r) const { return r * r - 2 * r + q * q; }
  Digits100 tortoise(const Digits100& r) const {
    if (q == 0) return r + 2 * log(abs(r / 2 - 1));
    const Digits100 logs = log(abs(delta(r)) / (q * q));
    if (q > 1) return r + logs + (2 - q * q) / d * (atan((r - 1) / d) + atan(1 / d));
    if (q == 1) return r + logs - 1 / (r - 1) - 1;
    return r + logs + (2 - q * q) / (2 * d) * log(abs((r - outer) * inner / ((r - inner) * outer)));
  }
  Digits100 q, d, outer, inner, circle, kappa, edges;
};

double error(const Digits100& value, const Digits100& exact) {
  return abs(exact) < 1e-60 ? static_cast<double>(abs(value))
                            : static_cast<double>(abs(value / exact - 1));
}

// Calls f(hole, its 100 digits, a place, its r with 100 digits) at places from 1e-9 r_- to 1e8, also
// beside each mark.
template <class F>
void at_places(const F& f) {
  for (const double q : kCharges) {
    const ChargedHole hole(1, q);
    const ExactHole wide(hole);
    for (const long double r :
         {1e-9L, 1e-3L, 0.2L, 0.7L, 0.999L, 1.0L, 1.3L, 1.999L, 2.5L, 3.7L, 1e3L, 1e8L})
      f(hole, wide, hole.at(r), Digits100(r));
    if (q > 0 && q < 1)
      for (const double part : {1e-3, 0.2, 0.3, 0.6, 0.999}) {
        const auto r = static_cast<double>(part * wide.inner);
        f(hole, wide, hole.at(r), Digits100(r));
      }
    for (const double off : {1e-3, -1e-3, 1e-9, -1e-9, 1e-20, -1e-20}) {
      if (hole.has_light_circle())
        f(hole, wide, hole.at(ChargedMark::kLightCircle, off), wide.circle + off);
      if (hole.is_naked()) continue;
      f(hole, wide, hole.at(ChargedMark::kOuterHorizon, off), wide.outer + off);
      if (q == 0) continue;
      const double own = off * hole.inner_horizon();
      f(hole, wide, hole.at(ChargedMark::kInnerHorizon, own), wide.inner + own);
    }
  }
}

TEST(ChargedHole, IsMarkedWhereAHundredDigitsSay) {
  for (const double q : kCharges) {
    const ChargedHole hole(1, q);
    const ExactHole wide(hole);
    if (q <= 1) {
      EXPECT_LT(error(hole.horizon(), wide.outer), kRoundings) << q;
      EXPECT_LT(error(hole.inner_horizon(), wide.inner), kRoundings) << q;
    } else {
      EXPECT_EQ(hole.horizon(), 0);
    }
    ASSERT_EQ(hole.has_light_circle(), wide.circle > 0) << q;
    if (!hole.has_light_circle()) continue;
    EXPECT_LT(error(hole.light_circle(), wide.circle), kRoundings) << q;
    EXPECT_LT(error(hole.critical_impact(), wide.kappa), kRoundings) << q;
    EXPECT_LT(error(hole.edges_end(), wide.edges), kRoundings) << q;
  }
}

TEST(ChargedHole, HasTheMarksOfTheTextbooks) {
  const ChargedHole none(1, 0.0L), extremal(1, 1.0L);
  EXPECT_EQ(none.horizon(), 2);
  EXPECT_EQ(none.light_circle(), 3);
  EXPECT_DOUBLE_EQ(none.last_stable_orbit(), 6);
  EXPECT_EQ(none.critical_impact(), Schwarzschild::kCriticalImpact);
  EXPECT_EQ(extremal.horizon(), 1);
  EXPECT_EQ(extremal.inner_horizon(), 1);
  EXPECT_EQ(extremal.light_circle(), 2);
  EXPECT_DOUBLE_EQ(extremal.last_stable_orbit(), 4);
  EXPECT_EQ(extremal.critical_impact(), 4);
  EXPECT_DOUBLE_EQ(extremal.edges_end(), 2 * sqrt2 - 2);
  // Here the two circles of light become one.
  const ChargedHole last(1, std::sqrt(1.125) - 1e-16);
  ASSERT_TRUE(last.has_light_circle());
  EXPECT_NEAR(last.light_circle(), 1.5, 1e-7);
  EXPECT_NEAR(last.critical_impact(), 1.5 * std::sqrt(6), 1e-14);
  EXPECT_FALSE(ChargedHole(1, std::sqrt(1.125) + 1e-15).has_light_circle());
}

TEST(ChargedHole, HasItsLastStableOrbitAtTheLargestRootOfTheCubic) {
  for (const double q : {0.0, 1e-8, 0.5, 0.8, 0.99, 1.0, 1.05, 1.1}) {
    const Digits100 r = ChargedHole(1, q).last_stable_orbit(), q2 = Digits100(q) * q;
    const Digits100 cubic = ((r - 6) * r + 9 * q2) * r - 4 * q2 * q2;
    const Digits100 slope = (3 * r - 12) * r + 9 * q2;
    EXPECT_GT(slope, 0) << q;
    EXPECT_GT(r, 2.49) << q;
    EXPECT_LT(abs(cubic / slope), 1e-13) << q;
  }
  EXPECT_EQ(ChargedHole(1, 2.0L).last_stable_orbit(), 4);
}

TEST(ChargedHole, HoldsTheLapseAndTheSpeedOfFreeFall) {
  at_places([](const ChargedHole& hole, const ExactHole& wide, const ChargedRadius& at,
               const Digits100& r) {
    const Digits100 f = wide.delta(r) / (r * r);
    EXPECT_LT(error(hole.lapse_squared(at), f), kRoundings) << hole.charge << " " << at.r;
    if (at.r < 1.5 * hole.fall_turns_at()) return;
    const Digits100 s = sqrt(2 * r - wide.q * wide.q) / r;
    EXPECT_LT(error(hole.free_fall_speed(at.r), s), kRoundings) << hole.charge << " " << at.r;
    // Rain has E = 1, and u^r = -s.
    const double w = hole.fall_celerity(at.r);
    EXPECT_NEAR(hole.radial_celerity(at, -hole.free_fall_speed(at.r), 1, 0, false), w,
                kRoundings * std::max(1.0, std::abs(w)))
        << hole.charge << " " << at.r;
  });
}

TEST(ChargedHole, RestsAtTheSpeedThatItsEnergySays) {
  at_places(
      [](const ChargedHole& hole, const ExactHole&, const ChargedRadius& at, const Digits100&) {
        const double f = hole.lapse_squared(at), root = std::sqrt(std::abs(f));
        if (f == 0 || at.r > 1e6) return;
        const double w = f > 0 ? hole.radial_celerity(at, 0, root, 0, false)
                               : hole.radial_celerity(at, -root, 0, 0, false);
        EXPECT_NEAR(hole.resting_celerity(at), w, kRoundings * (1 + std::abs(w)))
            << hole.charge << " " << at.r;
      });
}

TEST(ChargedHole, HasTheTortoiseCoordinateOfAHundredDigits) {
  at_places([](const ChargedHole& hole, const ExactHole& wide, const ChargedRadius& at,
               const Digits100& r) {
    if (hole.delta(at) == 0) return;
    const Digits100 exact = wide.tortoise(r);
    const double first = hole.is_naked() ? hole.charge : hole.inner_horizon();
    const double size =
        at.r < first / 4 ? static_cast<double>(abs(exact)) : static_cast<double>(abs(exact)) + at.r;
    // 100 digits cancel too: r* is r^3/(3 q^2) next to r = 0.
    const double lost =
        at.r < first / 4 ? 1e-97 * std::pow(first, 3) / static_cast<double>(exact) : 0;
    EXPECT_LT(static_cast<double>(abs(hole.tortoise(at) - exact)), (kRoundings + lost) * size)
        << hole.charge << " " << at.r;
  });
  EXPECT_EQ(ChargedHole(1, 1.0L).tortoise(1.0), -std::numeric_limits<double>::infinity());
}

TEST(ChargedHole, HasTheCriticalRaysOfAHundredDigits) {
  at_places([](const ChargedHole& hole, const ExactHole& wide, const ChargedRadius& at,
               const Digits100& r) {
    if (!hole.has_light_circle()) return;
    const auto t = hole.critical_tangents(at);
    const Digits100 c = wide.circle;
    const Digits100 square = r * r + 2 * r * c + c * c - wide.kappa * wide.kappa / c;
    ASSERT_EQ(t.real, square >= 0) << hole.charge << " " << at.r;
    const Digits100 x = (r - c) * sqrt(abs(square)), k = wide.kappa * r;
    EXPECT_LT(error(t.apart, (t.real ? 2 * x : 2 * abs(x)) / k), kRoundings);
    EXPECT_LT(error(t.first, (t.real ? r * r - x : r * r) / k), kRoundings);
    EXPECT_LT(error(t.second, (t.real ? r * r + x : r * r) / k), kRoundings);
  });
}

// The closed form in doubles has lost digits where the horizons are nearly one.
TEST(PixelTortoise, IsRStarOutside) {
  for (const long double q : {1e-6L, 0.5L, 0.95L, 1 - 1e-9L, 1.0L}) {
    const ChargedHole hole(1, q);
    const PixelTortoise pixels(hole);
    for (const double above : {1e-6, 0.1, 1.0, 7.0, 1e5}) {
      const double r = hole.horizon() + above, truth = hole.tortoise(r);
      EXPECT_NEAR(pixels.at(r, [](double x) { return std::log(x); }), truth,
                  1e-8 + 1e-9 * std::abs(truth))
          << static_cast<double>(q) << " " << r;
    }
    EXPECT_LT(pixels.at(hole.horizon(), [](double x) { return std::log(x); }), -10);
  }
}

}  // namespace
}  // namespace domefall
