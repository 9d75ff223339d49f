#include "trajectories/charged_orbit.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "tests/trajectories/conserved.h"
#include "tests/trajectories/wide_quadrature.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {
namespace {

// The same orbits in every run, unless the environment asks for others.
const int kSeededCharges = setenv("RC_PARAMS", "seed=20261121 max_success=300 noshrink=1", 0);

// ---- quadrature with 50 digits, which shares nothing with the code ----

struct Sums {
  double tau, azimuth, null_time;
};

// Free fall of these constants.
struct WideFall {
  Digits q2, excess, l2;

  Digits p(const Digits& w) const {
    return excess + w * (2 + w * (-(q2 + l2) + l2 * w * (2 - q2 * w)));
  }
  Digits lapse(const Digits& w) const { return 1 + w * (q2 * w - 2); }

  // What passes on the way in from far to near, which may be turning points.  The variable is ln w.
  Sums between(const Digits& far, const Digits& near) const {
    const Digits energy = sqrt(1 + excess), l = sqrt(l2);
    const auto rates = [&](const Digits& x) -> std::array<Digits, 3> {
      const Digits w = exp(x), under = p(w);
      if (!(under > 0)) return {0, 0, 0};
      const Digits speed = sqrt(under), rate = 1 / (w * speed);
      return {rate, Digits(rate * l * w * w), Digits(rate * (1 + l2 * w * w) / (energy + speed))};
    };
    constexpr int kPieces = 2;
    const auto sums = wide_integrals<3>(rates, log(1 / far), log(1 / near), kPieces);
    return {sums[0], sums[1], sums[2]};
  }
};

Digits square_of(long double value) { return Digits(value) * value; }

// The state at one r of a leg less that at another, against the sums between them.
void expect_between(const ChargedOrbit& orbit, const WideFall& fall, double far, double near) {
  const auto begin = orbit.time_at(far, Leg::kInward), end = orbit.time_at(near, Leg::kInward);
  ASSERT_TRUE(begin && end) << far << " " << near;
  const OrbitPoint a = orbit.at(*begin), b = orbit.at(*end);
  EXPECT_NEAR(a.r / far, 1, 1e-13);
  EXPECT_NEAR(b.r / near, 1, 1e-13);
  const Sums sums = fall.between(far, near);
  EXPECT_NEAR(double(*end - *begin) / sums.tau, 1, 1e-12) << far << " " << near;
  EXPECT_NEAR(b.azimuth - a.azimuth, sums.azimuth, 1e-12 * (1 + sums.azimuth))
      << far << " " << near;
  EXPECT_NEAR(double(b.null_time - a.null_time) / sums.null_time, 1, 3e-12) << far << " " << near;
}

TEST(ChargedOrbit, FallsAsQuadratureSays) {
  for (const long double q : charges()) {
    SCOPED_TRACE(testing::Message() << "q " << q);
    const ChargedHole hole(1, q);
    const double inside =
        hole.is_naked() ? hole.fall_turns_at() * 1.4 : std::max(0.05, hole.inner_horizon() * 0.99);
    const double beside = hole.is_naked() ? hole.fall_turns_at() * 2 : hole.horizon() + 1e-10;
    const Digits q2 = square_of(hole.charge_long());
    for (const double v : {0.0, 0.9, 1 - 1e-9})
      for (const double l : {0.0, 1e-6, 1.0}) {
        SCOPED_TRACE(testing::Message() << "v " << v << " L " << l);
        const double excess = v * v / ((1 - v) * (1 + v));
        const ChargedOrbit orbit = ChargedOrbit::falling(hole, 1e9, excess, l);
        if (orbit.innermost() > inside) continue;
        const WideFall fall{q2, excess, square_of(l)};
        EXPECT_EQ(double(orbit.at(0).null_time), 0);
        EXPECT_EQ(orbit.at(0).azimuth, 0);
        expect_between(orbit, fall, 1e9, 30);
        expect_between(orbit, fall, 30, beside);
        expect_between(orbit, fall, beside, inside);
      }
  }
}

TEST(ChargedOrbit, FallsFromRestAsQuadratureSays) {
  for (const long double q : charges()) {
    SCOPED_TRACE(testing::Message() << "q " << q);
    const ChargedHole hole(1, q);
    const Digits q2 = square_of(hole.charge_long());
    for (const double r : {1e9, 30.0, 2.5, hole.horizon() + 1e-10}) {
      if (hole.is_naked() && r < 2 * hole.fall_turns_at()) continue;
      for (const double l : {0.0, 0.7}) {
        SCOPED_TRACE(testing::Message() << "r " << r << " L " << l);
        const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, r, l);
        const Digits w = 1 / Digits(r), f = 1 + w * (q2 * w - 2);
        const WideFall fall{q2, f - 1 + f * l * l * w * w, square_of(l)};
        const OrbitPoint start = orbit.at(0);
        EXPECT_EQ(start.r, r);
        EXPECT_EQ(start.region, Region::kI);
        EXPECT_EQ(start.tetrad, Tetrad::kRain);
        EXPECT_NEAR(orbit.energy() / static_cast<double>(sqrt(1 + fall.excess)), 1, 1e-15);
        const double near = hole.is_naked() ? std::max(1.01 * orbit.innermost(), 0.9 * r)
                                            : std::max(0.05, hole.inner_horizon() * 0.99);
        if (near < r && near > orbit.innermost()) expect_between(orbit, fall, r, near);
      }
    }
  }
}

// What circles long, above the barrier and below it.
TEST(ChargedOrbit, WhirlsAsQuadratureSays) {
  for (const long double q : {0.1L, 0.8L, 0.99L, 1.0L}) {
    SCOPED_TRACE(testing::Message() << "q " << q);
    const ChargedHole hole(1, q);
    const Digits q2 = square_of(q);
    // The L of capture is that of the circle with E = 1, where f^2 = 1 - 3w + 2q^2 w^2, by Newton.
    Digits w = 1 / Digits(ChargedOrbit::by_momentum_excess(hole, 0, 1e-15).innermost());
    for (int k = 0; k < 8; ++k) {
      const Digits f = 1 + w * (q2 * w - 2);
      w -= (f * f - (1 + w * (2 * q2 * w - 3))) / (4 * f * (q2 * w - 1) - (4 * q2 * w - 3));
    }
    const Digits l2 = (1 - q2 * w) / (w * (1 + w * (2 * q2 * w - 3)));
    for (const double part : {1e-3, 1e-8, 1e-14}) {
      SCOPED_TRACE(testing::Message() << "excess " << part);
      const ChargedOrbit orbit = ChargedOrbit::by_momentum_excess(hole, 0, part);
      const WideFall fall{q2, 0, l2 * (1 + Digits(part)) * (1 + Digits(part))};
      expect_between(orbit, fall, 1e9, 20);
      // Down to the periastron, where rounding of r moves the time by the root of that.
      const double near = orbit.innermost() * (1 + 1e-6);
      const OrbitPoint p = orbit.at(*orbit.time_at(near, Leg::kInward));
      const Sums whole = fall.between(20, p.r);
      EXPECT_NEAR(p.azimuth - orbit.at(*orbit.time_at(20, Leg::kInward)).azimuth, whole.azimuth,
                  1e-11 * whole.azimuth);
    }
  }
}

// ---- what stays the same along the way ----

struct Case {
  const char* name;
  ChargedHole hole;
  ChargedOrbit orbit;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const long double q : charges()) {
    const ChargedHole hole(1, q);
    all.push_back({"rain", hole, ChargedOrbit::falling(hole, 30, 0, 0)});
    all.push_back({"fall with L", hole, ChargedOrbit::falling(hole, 30, 0, 2)});
    all.push_back({"fast fall", hole, ChargedOrbit::falling(hole, 30, 3, 1)});
    all.push_back({"from rest, radial", hole, ChargedOrbit::from_rest(hole, 60, 0)});
    all.push_back({"thrown up", hole, ChargedOrbit::thrown(hole, 9, 0.2, 0.1)});
    all.push_back({"thrown away", hole, ChargedOrbit::thrown(hole, 9, 5, 0.1)});
    all.push_back({"thrown around", hole, ChargedOrbit::thrown(hole, 30, 0, 0.2)});
    if (q > 2) continue;
    all.push_back({"from rest", hole, ChargedOrbit::from_rest(hole, 10, 1.5)});
    all.push_back({"parabola", hole, ChargedOrbit::by_periastron(hole, 7, 0)});
    all.push_back({"hyperbola", hole, ChargedOrbit::by_periastron(hole, 5, 1.5)});
    all.push_back({"hyperbola by b", hole, ChargedOrbit::scattered(hole, 1.5, 9)});
    all.push_back({"ellipse", hole, ChargedOrbit::between(hole, 9, 20)});
    all.push_back({"ellipse by shape", hole, ChargedOrbit::by_shape(hole, 9, 0.5)});
  }
  return all;
}

TEST(ChargedOrbit, KeepsItsEnergyAndAngularMomentum) {
  for (const Case& c : cases())
    for (const double share : {-0.99, -0.49, -0.1, -1e-3, 0.0, 1e-3, 0.2, 0.45, 0.8, 3.4}) {
      const double span = std::min(c.orbit.radial_period(), 100.0);
      const OrbitPoint p = c.orbit.at(share * span);
      const Conserved m = conserved_by(c.hole, p);
      EXPECT_NEAR(m.energy, c.orbit.energy(), 1e-12 * m.scale + m.rounding)
          << c.name << " " << p.r << " q " << c.hole.charge << " " << share;
      EXPECT_NEAR(m.momentum, c.orbit.angular_momentum(), 1e-13 * (1 + p.r)) << c.name;
      EXPECT_TRUE(has_tetrad(p.region, p.tetrad)) << c.name << " " << p.r;
      EXPECT_TRUE(p.r >= c.orbit.innermost() * (1 - 1e-15));
    }
}

rc::Gen<double> logarithmically(double low, double high) {
  constexpr int kSteps = 1 << 24;
  return rc::gen::map(rc::gen::inRange(0, kSteps + 1), [low, high](int k) {
    return low * std::exp(std::log(high / low) * k / kSteps);
  });
}

// Whatever is thrown, from wherever, keeps what it had, and is where time_at() says.
TEST(ChargedOrbit, ThrownAnywhereKeepsItsConstants) {
  EXPECT_TRUE(rc::check([] {
    const double off = *logarithmically(1e-10, 1);
    const auto q =
        *rc::gen::element(1 - static_cast<long double>(off), 1.0L, 1.0L + off, 0.3L, 2.5L);
    const ChargedHole hole(1, q);
    const double r = hole.horizon() + *logarithmically(hole.is_naked() ? 1e-6 : 1e-10, 1e8);
    const double up = *logarithmically(1e-6, 1e4), sign = *rc::gen::element(-1.0, 0.0, 1.0),
                 around = *logarithmically(1e-6, 1e4) * *rc::gen::element(0.0, 1.0);
    const ChargedOrbit orbit = ChargedOrbit::thrown(hole, r, sign * up, around);
    const OrbitPoint start = orbit.at(0);
    RC_ASSERT(std::abs(start.r / r - 1) <= 1e-13);
    const double f = hole.lapse_squared(start.r), gamma = std::hypot(1, sign * up, around);
    const Conserved at_start = conserved_by(hole, start);
    // The horizon itself has 19 digits.
    const double blurred = hole.is_naked() ? 0 : 1e-18 / hole.above_horizon(r);
    RC_ASSERT(std::abs(orbit.energy() / (std::sqrt(hole.lapse_squared(r)) * gamma) - 1) <=
              1e-13 + blurred);
    // Along R, against what rests.
    RC_ASSERT(std::abs(at_start.radial - sign * up * std::sqrt(f)) <=
              2e-12 * at_start.scale + 2 * at_start.rounding);
    const double part = *logarithmically(1e-6, 1);
    const double span = std::min({orbit.radial_period(), 1e3, orbit.death()});
    const OrbitPoint p = orbit.at(part * span);
    const Conserved m = conserved_by(hole, p);
    RC_ASSERT(std::isfinite(double(p.null_time)) && std::isfinite(p.azimuth));
    RC_ASSERT(std::abs(m.energy - orbit.energy()) <= 1e-12 * m.scale + m.rounding);
    RC_ASSERT(std::abs(m.momentum - r * around) <= 1e-13 * r * around);
    const auto again =
        orbit.time_at(p.r, m.radial > 0 ? Leg::kOutward : Leg::kInward, 0.999 * part * span);
    const double lost = 1e-14 * p.r / std::abs(m.radial);
    if (lost < std::min(1e-6, 1e-3 * part * span)) {
      RC_ASSERT(again.has_value());
      RC_ASSERT(std::abs(double(*again) - part * span) <= 1e-12 * (1 + part * span) + 10 * lost);
    }
  }));
}

TEST(ChargedOrbit, PassesTheHorizonsInTheirOrder) {
  const ChargedHole hole(1, 0.8L);
  const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, 10, 0);
  ASSERT_TRUE(orbit.passes());
  // Outside a hole of charge 0.8 horizons are at 1.6 and 0.4.
  const auto region = [&](double r, Leg leg) { return orbit.at(*orbit.time_at(r, leg, 0)); };
  EXPECT_EQ(region(5, Leg::kInward).region, Region::kI);
  EXPECT_EQ(region(5, Leg::kInward).universe, 0);
  EXPECT_EQ(region(1, Leg::kInward).region, Region::kII);
  EXPECT_EQ(region(0.39, Leg::kInward).region, Region::kV);
  EXPECT_EQ(region(0.39, Leg::kOutward).region, Region::kV);
  EXPECT_EQ(region(1, Leg::kOutward).region, Region::kIV);
  EXPECT_EQ(region(1, Leg::kOutward).universe, 1);
  EXPECT_EQ(region(5, Leg::kOutward).region, Region::kI);
  const OrbitPoint again = orbit.at(1.5 * orbit.radial_period() + 1e-3);
  EXPECT_EQ(again.universe, 1);
  EXPECT_EQ(again.region, Region::kV);
  // The product of both turning points of a radial fall is q^2/(1 - E^2).
  const double below = (1 - orbit.energy()) * (1 + orbit.energy());
  EXPECT_NEAR(orbit.innermost() * 10, 0.64 / below, 1e-12);
}

// What rises is in rain from the throw on, and of one t with what follows.
TEST(ChargedOrbit, ThrownUpStaysInItsTetradAndUniverse) {
  const ChargedHole hole(1, 0.8L);
  const ChargedOrbit orbit = ChargedOrbit::thrown(hole, 3, 0.3, 0);
  const OrbitPoint start = orbit.at(0), before = orbit.at(-1e-9), soon = orbit.at(1e-9);
  EXPECT_EQ(start.tetrad, Tetrad::kRain);
  EXPECT_EQ(before.tetrad, Tetrad::kOutgoing);
  EXPECT_EQ(start.universe, 0);
  EXPECT_EQ(before.universe, 0);
  EXPECT_NEAR(double(soon.null_time), 0, 1e-8);
  // v - u = 2 r*, up to the t of the throw, at which v is 0.
  EXPECT_NEAR(double(start.null_time - before.null_time), 2 * hole.tortoise(3.0), 1e-8);
  const double top = double(*orbit.time_at(orbit.outermost(), Leg::kInward, 0));
  EXPECT_GT(top, 0);
  EXPECT_EQ(orbit.at(top * 0.999).tetrad, Tetrad::kRain);
  EXPECT_EQ(orbit.at(top * 1.001).tetrad, Tetrad::kRain);
  EXPECT_NEAR(double(orbit.at(top * (1 - 1e-9)).null_time),
              double(orbit.at(top * (1 + 1e-9)).null_time), 1e-7);
  EXPECT_EQ(orbit.at(top + orbit.radial_period() / 2 - 1e-6).region, Region::kV);
}

// Between the horizons things may be thrown towards either universe.
TEST(ChargedOrbit, ThrownInsideGoesTowardsEitherUniverse) {
  const ChargedHole hole(1, 0.8L);
  for (const double along : {-3.0, 0.4, 5.0})
    for (const double around : {0.0, 0.7}) {
      const ChargedOrbit orbit = ChargedOrbit::thrown_from_tetrad(hole, 1, along, around);
      const bool other = ChargedOrbit::has_negative_energy(hole, 1, along, around);
      EXPECT_EQ(other, along > 4);
      const OrbitPoint start = orbit.at(0);
      EXPECT_EQ(start.region, Region::kII);
      EXPECT_NEAR(start.r, 1, 1e-14);
      // Towards the other one the celerity is that in its own tetrad: R and E change their signs.
      const double f = hole.lapse_squared(1.0), t = (1 + f) / 2, s = (1 - f) / 2,
                   gamma = std::hypot(1, along, around);
      const double energy = t * gamma - s * along, rate = t * along - s * gamma;
      EXPECT_NEAR(orbit.energy(), std::abs(energy), 1e-14 * gamma);
      EXPECT_NEAR(conserved_by(hole, start).radial, rate, 1e-13 * gamma);
      EXPECT_NEAR(start.celerity.z, around, 1e-14);
    }
  EXPECT_THROW(ChargedOrbit::thrown_from_tetrad(hole, 1, hole.resting_celerity(1.0), 0),
               std::domain_error);
}

// Null times join where the tetrad changes, at the periastron and far away: v - u = 2 r*.
TEST(ChargedOrbit, HasNullTimesOfOneT) {
  const ChargedHole hole(1, 0.8L);
  const ChargedOrbit orbit = ChargedOrbit::from_rest(hole, 10, 0.5);
  const double step = 1e-9, half = orbit.radial_period() / 2;
  const OrbitPoint before = orbit.at(half - step), after = orbit.at(half + step);
  EXPECT_NEAR(double(before.null_time - after.null_time), 2 * hole.tortoise(orbit.innermost()),
              1e-7);
  const OrbitPoint out = orbit.at(2 * half - step), in = orbit.at(2 * half + step);
  EXPECT_NEAR(double(in.null_time - out.null_time), 2 * hole.tortoise(10), 1e-7);
}

}  // namespace
}  // namespace domefall
