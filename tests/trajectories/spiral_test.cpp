#include "trajectories/spiral.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/trajectories/conserved.h"
#include "tests/trajectories/motion.h"
#include "trajectories/circular_orbit.h"

namespace domefall {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Starts from next to the light circle to the farthest, with few turns and with many.
template <class Test>
void for_all_spirals(const Test& test) {
  for (const double r : {3 + 1e-9, 3.0001, 3.5, 4.0, 5.9999, 6 - 1e-12, 6.0, 6 + 1e-12, 6.0001, 7.0,
                         12.0, 1e3, 1e6, 1e9})
    for (const double turns : {0.5, 1.0, 3.0, 30.0, 1000.0}) {
      SCOPED_TRACE(testing::Message() << "from r = " << r << " with " << turns << " turns");
      test(r, turns, Spiral(r, turns));
    }
}

TEST(Spiral, BeginsOnTheFreeCircle) {
  for_all_spirals([](double r, double, const Spiral& spiral) {
    const OrbitPoint p = spiral.at(0), circle = CircularOrbit{r}.at(0);
    EXPECT_EQ(p.r, r);
    EXPECT_EQ(p.azimuth, 0);
    EXPECT_EQ(p.null_time.hi, 0);
    EXPECT_EQ(p.celerity, circle.celerity);
    EXPECT_EQ(spiral.at(-5).azimuth, CircularOrbit{r}.at(-5).azimuth);
    // The first instant with engines is no other.
    const OrbitPoint next = spiral.at(std::nextafter(spiral.pushed(), 1e300));
    EXPECT_NEAR(next.celerity.x, circle.celerity.x, 1e-12 * circle.celerity.x);
    EXPECT_NEAR(next.celerity.z, circle.celerity.z, 1e-12 * circle.celerity.z);
  });
}

TEST(Spiral, MeetsTheHorizonAfterItsTurns) {
  for_all_spirals([](double r, double turns, const Spiral& spiral) {
    const OrbitPoint p = spiral.at(spiral.time_at(2, Leg::kInward).value());
    EXPECT_NEAR(p.r, 2, 1e-13);
    const bool is_beside_six = r > 6 && r < 6.001;
    EXPECT_NEAR(p.azimuth / (kTurn * turns), 1, is_beside_six ? 1e-10 : 1e-12);
  });
}

// From r_c <= 6 M, the fall has come off the circle: with w = 1/r and an azimuth psi to go,
// w - w_c = y/sinh^2(psi sqrt(y/2) + atanh sqrt(y/(2 w_c))), or 2/(psi + sqrt 6)^2 from 6 M.
TEST(Spiral, FallsOffTheCircleAsItsClosedFormSays) {
  for (const double circle : {3.0001, 3.5, 4.0, 5.0, 5.99, 6.0})
    for (const double turns : {0.5, 2.0, 20.0}) {
      const Spiral spiral(circle, turns);
      const double w_c = 1 / circle, root = std::sqrt((6 - circle) / (2 * circle));
      for (double part = 0.001; part < 0.995; part += 0.01) {
        const ProperTime tau =
            spiral.released() + part * double(spiral.death() - spiral.released());
        const OrbitPoint p = spiral.at(tau);
        const double left = kTurn * turns - p.azimuth;
        const double over = circle == 6
                                ? 2 / std::pow(left + std::sqrt(6.0), 2)
                                : std::pow(root / std::sinh(left * root / std::numbers::sqrt2 +
                                                            std::atanh(root / std::sqrt(2 * w_c))),
                                           2);
        EXPECT_NEAR(p.r * (w_c + over), 1, 1e-11) << circle << " " << turns << " " << part;
      }
    }
}

// A Motion is what a geodesic of angular momentum L does: r'' = -1/r^2 + L^2/r^3 - 3 L^2/r^4.
struct Motion {
  double r, speed, azimuth, null_time;
};
Motion rates(const Motion& m, double energy, double l) {
  const double r = m.r, l2 = l * l / (r * r);
  return {m.speed, (-1 + l2 * (r - 3)) / (r * r), l / (r * r), (1 + l2) / (energy - m.speed)};
}
Motion moved(const Motion& m, const Motion& rate, double h) {
  return {m.r + h * rate.r, m.speed + h * rate.speed, m.azimuth + h * rate.azimuth,
          m.null_time + h * rate.null_time};
}

// Runge and Kutta's method of the fourth order, which shares nothing with the code.
TEST(Spiral, FallsFreelyOnceTheEnginesStop) {
  for (const double from_r : {4.0, 6.0, 6.5, 12.0, 100.0, 1e6}) {
    const Spiral spiral(from_r, 3);
    const OrbitPoint start = spiral.at(spiral.released());
    const double energy = energy_of(start), l = angular_momentum_of(start);
    const double end = double(*spiral.time_at(1, Leg::kInward) - spiral.released());
    // Off a whirling circle rounding grows by e^9.
    const double bound = from_r < 6 ? 1e-9 : 1e-10;
    constexpr int kSteps = 80000;
    const double h = end / kSteps;
    Motion m{start.r, radial_speed_of(start), start.azimuth, double(start.null_time)};
    for (int k = 0; k < kSteps; ++k) {
      const Motion a = rates(m, energy, l), b = rates(moved(m, a, h / 2), energy, l),
                   c = rates(moved(m, b, h / 2), energy, l), d = rates(moved(m, c, h), energy, l);
      m = moved(moved(moved(moved(m, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
      if (k % 2000 != 1999) continue;
      const OrbitPoint p = spiral.at(spiral.released() + (k + 1) * h);
      EXPECT_NEAR(p.r, m.r, bound) << from_r << " " << k;
      EXPECT_NEAR(p.azimuth, m.azimuth, bound) << from_r << " " << k;
      EXPECT_NEAR(radial_speed_of(p), m.speed, 10 * bound) << from_r << " " << k;
      EXPECT_NEAR(double(p.null_time), m.null_time, 1e-10 * m.null_time) << from_r << " " << k;
    }
  }
}

// The four-velocity, integrated over proper time, makes the way.
TEST(Spiral, MovesAsItsVelocitiesSay) {
  for (const double from_r : {3.1, 5.0, 6.0, 6.01, 12.0, 1e3}) {
    const Spiral spiral(from_r, 2.5);
    constexpr int kPieces = 200;
    const double begin = spiral.pushed(), end = double(spiral.released());
    double r = from_r, azimuth = spiral.at(begin).azimuth,
           null_time = double(spiral.at(begin).null_time);
    using Gauss = boost::math::quadrature::gauss<double, 20>;
    for (int k = 0; k < kPieces; ++k) {
      // The pieces become shorter towards the end, where things are quick.
      const auto cut = [&](int at) {
        return end - (end - begin) * std::pow(1 - double(at) / kPieces, 3);
      };
      const double low = cut(k), high = cut(k + 1);
      r += Gauss::integrate([&](double tau) { return radial_speed_of(spiral.at(tau)); }, low, high);
      azimuth += Gauss::integrate(
          [&](double tau) {
            const OrbitPoint p = spiral.at(tau);
            return p.celerity.z / p.r;
          },
          low, high);
      null_time += Gauss::integrate(
          [&](double tau) {
            const OrbitPoint p = spiral.at(tau);
            return (1 + p.celerity.z * p.celerity.z) / (energy_of(p) - radial_speed_of(p));
          },
          low, high);
      const OrbitPoint p = spiral.at(high);
      EXPECT_NEAR(p.r, r, 1e-12 * from_r) << from_r << " " << k;
      EXPECT_NEAR(p.azimuth, azimuth, 1e-11 * (1 + azimuth)) << from_r << " " << k;
      EXPECT_NEAR(double(p.null_time), null_time, 1e-11 * (1 + null_time)) << from_r << " " << k;
    }
  }
}

// Beyond 6 M the angular momentum is that of the free orbits; from there on it stays.
TEST(Spiral, HasTheAngularMomentumOfFreeOrbits) {
  const Spiral spiral(20, 5);
  for (double part = 0.01; part < 1; part += 0.01) {
    const OrbitPoint p = spiral.at(part * spiral.death());
    const double l = p.r > 6 ? p.r / std::sqrt(p.r - 3) : std::sqrt(12.0);
    EXPECT_NEAR(angular_momentum_of(p), l, 1e-13 * l) << part;
  }
}

// The felt acceleration, by differences: a_t = -dE/dtau and a_phi = dL/dtau, and
// a^r = r'' + 1/r^2 - (r - 3) L^2/r^4.
double felt(const Spiral& spiral, double tau, double h) {
  const OrbitPoint p = spiral.at(tau), before = spiral.at(tau - h), after = spiral.at(tau + h);
  const double l = angular_momentum_of(p), f = 1 - 2 / p.r;
  const double energy_rate = (energy_of(after) - energy_of(before)) / (2 * h);
  const double spin = (angular_momentum_of(after) - angular_momentum_of(before)) / (2 * h) / p.r;
  const double push = (radial_speed_of(after) - radial_speed_of(before)) / (2 * h) +
                      (1 - (p.r - 3) * l * l / (p.r * p.r)) / (p.r * p.r);
  return std::sqrt(std::max(0.0, (push * push - energy_rate * energy_rate) / f + spin * spin));
}

TEST(Spiral, FeelsItsEnginesComeAndGoWithoutAJump) {
  for (const double from_r : {4.0, 6.0, 8.0, 12.0}) {
    const Spiral spiral(from_r, 4);
    const double begin = spiral.pushed(), end = double(spiral.released()), h = 1e-3;
    double most = 0;
    for (double part = 0.005; part < 1; part += 0.01)
      most = std::max(most, felt(spiral, std::lerp(begin, end, part), h));
    EXPECT_GT(most, 1e-6) << from_r;
    EXPECT_LT(most, 0.02) << from_r;
    const double soon = 1e-3 * (end - begin);
    EXPECT_LT(felt(spiral, begin + soon, h), 0.05 * most) << from_r;
    EXPECT_LT(felt(spiral, end - soon, h), 0.05 * most) << from_r;
    EXPECT_LT(felt(spiral, end + soon, h), 1e-7) << from_r;
  }
}

TEST(Spiral, HasNoJumpWhereItsPartsMeet) {
  for_all_spirals([](double from_r, double, const Spiral& spiral) {
    const double soon = 1e-15 * std::min(1.0, period(CircularOrbit{from_r}));
    for (const ProperTime& tau : {ProperTime(spiral.pushed()), spiral.released()}) {
      const OrbitPoint a = spiral.at(tau - soon), b = spiral.at(tau), c = spiral.at(tau + soon);
      for (const OrbitPoint& next : {b, c}) {
        EXPECT_NEAR(next.r / a.r, 1, 1e-12);
        EXPECT_NEAR(next.azimuth, a.azimuth, 1e-12 * (1 + a.azimuth));
        EXPECT_NEAR(double(next.null_time), double(a.null_time),
                    1e-12 * (1 + double(a.null_time)) + 1e-15 * spiral.death());
        EXPECT_LT((next.celerity - a.celerity).length(), 1e-11 * (1 + a.celerity.length()));
      }
    }
  });
}

TEST(Spiral, OnlyFallsAndIsFoundAtEachRadius) {
  for_all_spirals([](double from_r, double, const Spiral& spiral) {
    const double end = spiral.death(), start = spiral.pushed();
    double before = from_r;
    for (int k = 1; k < 400; ++k) {
      const OrbitPoint p = spiral.at(start + (end - start) * k / 400);
      ASSERT_LE(p.r, before);
      ASSERT_GT(p.r, 0);
      ASSERT_TRUE(std::isfinite(p.celerity.length()) && std::isfinite(p.azimuth) &&
                  std::isfinite(double(p.null_time)));
      ASSERT_EQ(p.region, p.r > 2 ? Region::kI : Region::kII);
      ASSERT_EQ(p.tetrad, Tetrad::kRain);
      before = p.r;
    }
    for (double r = 0.999 * from_r; r > 1e-6; r *= 0.7) {
      const auto tau = spiral.time_at(r, Leg::kInward);
      ASSERT_TRUE(tau);
      EXPECT_NEAR(spiral.at(*tau).r / r, 1, 1e-12);
      EXPECT_FALSE(spiral.time_at(r, Leg::kInward, *tau + 1e-3 * end));
      EXPECT_FALSE(spiral.time_at(r, Leg::kOutward));
    }
    EXPECT_EQ(double(spiral.time_at(from_r, Leg::kInward).value()), spiral.pushed());
    EXPECT_FALSE(spiral.time_at(1.001 * from_r, Leg::kInward));
    EXPECT_FALSE(spiral.time_at(-1, Leg::kInward));
  });
}

// Near a charge, too, it shrinks through free orbits and falls freely, with no jump.
TEST(Spiral, NearAChargeShrinksAndFalls) {
  for (const long double q : {0.1L, 0.5L, 0.8L, 0.99L, 1.0L}) {
    const ChargedHole hole(1, q);
    const double light = hole.light_circle(), stable = hole.last_stable_orbit();
    for (const double from_r : {light * 1.02, (light + stable) / 2, stable, 1.5 * stable, 1e3})
      for (const double turns : {0.8, 3.0, 40.0}) {
        SCOPED_TRACE(testing::Message()
                     << "q " << double(q) << " from " << from_r << ", " << turns);
        const Spiral spiral(from_r, turns, hole);
        const OrbitPoint inside = spiral.at(*spiral.time_at(hole.horizon(), Leg::kInward));
        EXPECT_NEAR(inside.azimuth / (2 * std::numbers::pi), turns, 1e-11 * turns);
        const ProperTime released = spiral.released();
        const double soon = 1e-13 * double(released);
        for (const ProperTime& tau : {ProperTime(spiral.pushed()), released}) {
          const OrbitPoint a = spiral.at(tau - soon), b = spiral.at(tau + soon);
          EXPECT_LT((b.celerity - a.celerity).length(), 1e-11 * (1 + double(released)));
          EXPECT_NEAR(b.r, a.r, 1e-11 * (a.r + double(released)));
          EXPECT_NEAR(double(b.null_time), double(a.null_time), 1e-11 * (1 + double(released)));
        }
        const Conserved freed = conserved_by(hole, spiral.at(released + soon));
        for (const double r :
             {0.99 * spiral.at(released).r, hole.horizon(), 1.01 * hole.inner_horizon()}) {
          const auto tau = spiral.time_at(r, Leg::kInward, released);
          if (!tau) continue;
          const Conserved m = conserved_by(hole, spiral.at(*tau));
          EXPECT_NEAR(m.energy, freed.energy, 1e-12 * m.scale) << r;
          EXPECT_NEAR(m.momentum, freed.momentum, 1e-12 * freed.momentum) << r;
        }
        // Before, the angular momentum is that of the circle of its radius.
        for (const double part : {0.1, 0.5, 0.9}) {
          const OrbitPoint p = spiral.at(std::lerp(spiral.pushed(), double(released), part));
          const double r = std::clamp(p.r, std::min(from_r, stable), 1e9);
          EXPECT_NEAR(p.r * p.celerity.z / (r / hole.circling_time(r)), 1, 1e-12) << p.r;
        }
        using Gauss = boost::math::quadrature::gauss<double, 20>;
        const double low = std::lerp(spiral.pushed(), double(released), 0.4),
                     high = std::lerp(spiral.pushed(), double(released), 0.41);
        const double way = Gauss::integrate(
            [&](double tau) { return conserved_by(hole, spiral.at(tau)).radial; }, low, high);
        EXPECT_NEAR(spiral.at(high).r - spiral.at(low).r, way, 1e-12 * from_r);
      }
  }
  EXPECT_EQ(Spiral(8, 2, ChargedHole(1, 0.8L)).death(), INFINITY);
}

TEST(Spiral, RefusesWhatIsNoOrbit) {
  EXPECT_THROW(Spiral(2.48, 2, ChargedHole(1, 0.8L)), std::domain_error);
  // There the engines alone need 0.7 turns.
  EXPECT_THROW(Spiral(20, 0.6, ChargedHole(1, 1.0L)), std::domain_error);
  EXPECT_THROW(Spiral(3, 2), std::domain_error);
  EXPECT_THROW(Spiral(-1, 2), std::domain_error);
  EXPECT_THROW(Spiral(std::nan(""), 2), std::domain_error);
  EXPECT_THROW(Spiral(INFINITY, 2), std::domain_error);
  EXPECT_THROW(Spiral(8, 0.49), std::domain_error);
  EXPECT_THROW(Spiral(8, 1001), std::domain_error);
  EXPECT_THROW(Spiral(8, std::nan("")), std::domain_error);
  const Spiral spiral(8, 2);
  EXPECT_THROW(spiral.at(spiral.death() * 1.001), std::domain_error);
  EXPECT_THROW(spiral.at(std::nan("")), std::domain_error);
}

}  // namespace
}  // namespace domefall
