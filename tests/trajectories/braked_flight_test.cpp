#include "trajectories/braked_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/trajectories/conserved.h"
#include "tests/trajectories/motion.h"
#include "trajectories/static_observer.h"

namespace domefall {
namespace {

double free_fall(double r) { return std::sqrt(2 / r); }

struct Brake {
  double from_r, stop_r, speed;
};
const std::vector<Brake>& brakes() {
  static const std::vector<Brake> all{{30, 5, free_fall(30)},
                                      {1e3, 10, 0.3},
                                      {1e6, 2.5, free_fall(1e6)},
                                      {1e9, 3, 1e-6},
                                      {1e9, 2 + 1e-9, 0.5},
                                      {6, 2.0001, 0.9999999999},
                                      {5, 4.999999, free_fall(5)},
                                      {2 + 1e-9, 2 + 5e-10, 0.5},
                                      {20, 4, 0.7},
                                      {1e9, 2 + 1e-15, 1e-6},
                                      {10, 3, 1 - 1e-16}};
  return all;
}

TEST(BrakedFlight, BeginsAtItsSpeedAndEndsAtRest) {
  for (const Brake& c : brakes()) {
    SCOPED_TRACE(testing::Message() << c.from_r << " to " << c.stop_r);
    const BrakedFlight flight(c.from_r, c.stop_r, c.speed);
    const OrbitPoint begin = flight.at(0), end = flight.at(flight.duration());
    EXPECT_NEAR(begin.r / c.from_r, 1, 1e-15);
    // Against the rain both the flight's rapidity and that of what rests are along R.
    const double rapidity = -std::atanh(c.speed), rest = resting_celerity(c.from_r).x;
    EXPECT_NEAR(begin.celerity.x,
                std::sinh(rapidity) * std::sqrt(1 + rest * rest) + std::cosh(rapidity) * rest,
                1e-14 * std::cosh(rapidity) * (1 + rest));
    EXPECT_EQ(end.r, c.stop_r);
    EXPECT_EQ(end.celerity, resting_celerity(c.stop_r));
    const OrbitPoint last = flight.at(std::nextafter(flight.duration(), 0));
    EXPECT_NEAR(last.r / c.stop_r, 1, 1e-15);
    EXPECT_NEAR(last.celerity.x / end.celerity.x, 1, 1e-8);
    EXPECT_NEAR(double(last.null_time), double(end.null_time), 1e-12 * double(end.null_time));
    // Then it hovers.
    const OrbitPoint later = flight.at(flight.duration() + 8);
    EXPECT_EQ(later.celerity, end.celerity);
    EXPECT_NEAR(double(later.null_time - end.null_time), 8 / std::sqrt(1 - 2 / c.stop_r),
                1e-6 * 8 / std::sqrt(1 - 2 / c.stop_r));
  }
}

TEST(BrakedFlight, GoesOnFromAFall) {
  EXPECT_NEAR(BrakedFlight(30, 5, free_fall(30)).at(0).celerity.x, 0, 1e-15);
}

// Runge and Kutta's method of the fourth order, of dr/dtau = -sqrt(f) sinh psi and
// dv/dtau = exp(-psi)/sqrt(f).
TEST(BrakedFlight, MovesAsItsEquationSays) {
  for (const Brake& c : {Brake{30, 5, free_fall(30)}, Brake{1e3, 10, 0.3}, Brake{8, 2.01, 0.9},
                         Brake{20, 4, 0.7}, Brake{100, 6, 0.99}}) {
    const BrakedFlight flight(c.from_r, c.stop_r, c.speed);
    const auto rates = [&](double r) {
      const double psi =
          std::atanh(c.speed) * std::pow((r - c.stop_r) / (c.from_r - c.stop_r), 2.0 / 3);
      const double lapse = std::sqrt(1 - 2 / r);
      return std::pair(-lapse * std::sinh(psi), std::exp(-psi) / lapse);
    };
    constexpr int kSteps = 40000;
    const double h = 0.95 * flight.duration() / kSteps;
    double r = c.from_r, null_time = 0;
    for (int k = 0; k < kSteps; ++k) {
      const auto a = rates(r), b = rates(r + h / 2 * a.first), d = rates(r + h / 2 * b.first),
                 e = rates(r + h * d.first);
      r += h / 6 * (a.first + 2 * b.first + 2 * d.first + e.first);
      null_time += h / 6 * (a.second + 2 * b.second + 2 * d.second + e.second);
      if (k % 1000 != 999) continue;
      const OrbitPoint p = flight.at((k + 1) * h);
      EXPECT_NEAR(p.r / r, 1, 1e-12) << c.from_r << " " << k;
      EXPECT_NEAR(double(p.null_time) / null_time, 1, 1e-12) << c.from_r << " " << k;
      EXPECT_NEAR(radial_speed_of(p), rates(r).first, 1e-12) << c.from_r << " " << k;
    }
  }
}

// The same near a charge, from f written out.
TEST(BrakedFlight, NearAChargeMovesAsItsEquationSays) {
  for (const auto& [q, c] : {std::pair(0.8L, Brake{30, 5, 0.4}),
                             {0.8L, Brake{8, 1.6 + 1e-5, 0.9}},
                             {1.0L, Brake{1e3, 1.001, 0.3}},
                             {1 - 1e-12L, Brake{20, 1.1, 0.7}},
                             {1.2L, Brake{20, 0.2, 0.9}},
                             {3.0L, Brake{1e9, 1, 0.9}}}) {
    SCOPED_TRACE(testing::Message() << "q " << double(q) << ", " << c.from_r << " to " << c.stop_r);
    const ChargedHole hole(1, q);
    const BrakedFlight flight(c.from_r, c.stop_r, c.speed, hole);
    const auto f = [q2 = double(q * q)](double r) { return 1 - 2 / r + q2 / (r * r); };
    const auto rapidity = [&c = c](double r) {
      return std::atanh(c.speed) * std::pow((r - c.stop_r) / (c.from_r - c.stop_r), 2.0 / 3);
    };
    for (const double r : {c.from_r, 0.7 * c.from_r, 1.5 * c.stop_r, 1.01 * c.stop_r}) {
      const double tau = double(*flight.time_at(r, Leg::kInward));
      const OrbitPoint p = flight.at(tau);
      EXPECT_NEAR(p.r / r, 1, 1e-12);
      // dr/dtau is this.  E and dr/dtau are sqrt(f) cosh psi and -sqrt(f) sinh psi.
      const Conserved m = conserved_by(hole, p);
      EXPECT_NEAR(m.radial, -std::sqrt(f(r)) * std::sinh(rapidity(r)), 1e-11 * m.scale);
      EXPECT_NEAR(m.energy, std::sqrt(f(r)) * std::cosh(rapidity(r)), 1e-11 * m.scale);
      // Gauss's rule over a short way behind it.
      const double h = 1e-3 * (flight.duration() - tau), gauss = std::sqrt(0.6);
      double way = 0, null_time = 0;
      for (const auto& [x, weight] :
           {std::pair(-gauss, 5.0 / 18), {0.0, 8.0 / 18}, {gauss, 5.0 / 18}}) {
        const double at = flight.at(tau + h * (1 + x) / 2).r, lapse = std::sqrt(f(at));
        way += h * weight * lapse * std::sinh(rapidity(at));
        null_time += h * weight * std::exp(-rapidity(at)) / lapse;
      }
      const OrbitPoint next = flight.at(tau + h);
      EXPECT_NEAR((p.r - next.r) / way, 1, 1e-9 + 1e-15 * p.r / way);
      EXPECT_NEAR(double(next.null_time - p.null_time) / null_time, 1, 1e-9);
    }
    const OrbitPoint end = flight.at(flight.duration() + 3);
    EXPECT_EQ(end.celerity, resting_celerity(hole, c.stop_r, Tetrad::kRain));
    EXPECT_EQ(end.r, c.stop_r);
    EXPECT_NEAR(flight.at(std::nextafter(flight.duration(), 0)).celerity.x / end.celerity.x, 1,
                1e-8);
  }
  EXPECT_THROW(BrakedFlight(5, 1.6, 0.5, ChargedHole(1, 0.8L)), std::domain_error);
}

// The felt acceleration is dE/dr.  It ends as that of hovering.
TEST(BrakedFlight, FeelsAFiniteBrakeThatGoesOverIntoHovering) {
  for (const Brake& c : {Brake{30, 5, free_fall(30)}, Brake{1e3, 10, 0.3}, Brake{8, 2.1, 0.5}}) {
    const BrakedFlight flight(c.from_r, c.stop_r, c.speed);
    const double hover = 1 / (c.stop_r * c.stop_r * std::sqrt(1 - 2 / c.stop_r));
    double most = 0, last = 0;
    for (int k = 1; k < 1000; ++k) {
      const double tau = flight.duration() * k / 1000, h = 1e-4 * flight.duration();
      const OrbitPoint a = flight.at(tau - h), b = flight.at(tau + h);
      if (std::abs(b.r - a.r) < 1e-9) break;
      last = (energy_of(b) - energy_of(a)) / (b.r - a.r);
      most = std::max(most, last);
      EXPECT_GT(last, 0) << c.from_r << " " << k;
    }
    EXPECT_NEAR(last / hover, 1, 0.05) << c.from_r;
    EXPECT_LT(most, 4 * hover + c.speed / (1 - c.speed) / (c.from_r - c.stop_r)) << c.from_r;
  }
}

TEST(BrakedFlight, GoesOneWayAndIsFoundAtEachRadius) {
  for (const Brake& c : brakes()) {
    SCOPED_TRACE(testing::Message() << c.from_r << " to " << c.stop_r);
    const BrakedFlight flight(c.from_r, c.stop_r, c.speed);
    double before = c.from_r;
    for (int k = 0; k <= 400; ++k) {
      const OrbitPoint p = flight.at(flight.duration() * k / 400);
      ASSERT_LE(p.r, before);
      ASSERT_GT(p.r, 2);
      ASSERT_TRUE(std::isfinite(p.celerity.x) && std::isfinite(double(p.null_time)));
      before = p.r;
    }
    for (const double part : {0.0, 1e-6, 0.1, 0.5, 0.999, 1.0}) {
      const double r = std::lerp(c.from_r, c.stop_r, part);
      const auto tau = flight.time_at(r, Leg::kInward);
      ASSERT_TRUE(tau);
      // A rounding of tau moves r by that times dr/dtau.
      const double rounding = 1e-15 * flight.duration() * std::sinh(std::atanh(c.speed));
      EXPECT_NEAR(flight.at(*tau).r / r, 1, 1e-11 + rounding);
      EXPECT_FALSE(flight.time_at(r, Leg::kInward, 2 * flight.duration()));
      EXPECT_FALSE(flight.time_at(r, Leg::kOutward));
    }
    EXPECT_EQ(double(flight.time_at(c.stop_r, Leg::kInward).value()), flight.duration());
    EXPECT_EQ(flight.reach(), std::pair(c.stop_r, c.from_r));
    EXPECT_FALSE(flight.time_at(c.from_r * 2, Leg::kInward));
  }
}

TEST(BrakedFlight, RefusesWhatCannotBeFlown) {
  EXPECT_THROW(BrakedFlight(2, 5, 0.1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 2, 0.1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 5, 0.1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 6, 0.1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 3, 0), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 3, 1), std::domain_error);
  EXPECT_THROW(BrakedFlight(std::nan(""), 3, 0.1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 3, std::nan("")), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 3, 0.1).at(-1), std::domain_error);
  EXPECT_THROW(BrakedFlight(5, 3, 0.1).at(std::nan("")), std::domain_error);
}

}  // namespace
}  // namespace domefall
