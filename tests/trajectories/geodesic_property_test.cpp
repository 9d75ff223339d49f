// Whatever is thrown, from wherever: its constants, its proper times, and the radial equation of
// motion integrated step by step, which knows neither turning points nor elliptic integrals.  More:
// RC_PARAMS="max_success=10000 seed=..." test_trajectories
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_fehlberg78.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <cstdlib>

#include "tests/trajectories/motion.h"
#include "trajectories/infall.h"
#include "trajectories/kruskal_crossing.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

// The same orbits in every run, unless the environment asks for others.
const int kSeeded = setenv("RC_PARAMS", "seed=20261121 max_success=300 noshrink=1", 0);

rc::Gen<double> logarithmic(double low, double high) {
  constexpr int kSteps = 1 << 24;
  return rc::gen::map(rc::gen::inRange(0, kSteps + 1), [low, high](int k) {
    return low * std::exp(std::log(high / low) * k / kSteps);
  });
}

struct Thrown {
  Geodesic orbit;
  double tau;  // of a state to look at
};

Thrown drawn() {
  const int kind = *rc::gen::inRange(0, 4);
  const double part = *logarithmic(1e-6, 1);
  // One after the other: the order of a call's arguments is the compiler's.
  const double slow = *logarithmic(1e-4, 100), small = *logarithmic(1e-9, 1e-2);
  const double near = *logarithmic(1e-3, 1e4), fast = *logarithmic(1e-4, 1e3);
  const double sign = *rc::gen::element(-1.0, 1.0), way = *rc::gen::element(-1.0, 1.0);
  const auto orbit = [&] {
    if (kind == 0) return thrown_outside(2 + near, sign * fast, slow);
    if (kind == 1) return thrown_from_rain(near, sign * fast, slow);
    if (kind == 2) return kruskal_crossing(fast, slow);
    // Near circles, where whirls are.
    const double r = 3 + slow;
    return thrown_outside(r, sign * small * small, (1 + way * small) / std::sqrt(r - 3));
  }();
  const bool past = *rc::gen::arbitrary<bool>();
  const double most = std::min(past ? -orbit.birth() : orbit.death(), 1e4);
  return {orbit, (past ? -1 : 1) * most * (0.999 - 0.99 * part)};
}

void check_constants(const Geodesic& orbit, const OrbitPoint& p) {
  RC_ASSERT(p.r > 0 && std::isfinite(p.r) && std::isfinite(double(p.null_time)));
  RC_ASSERT(has_tetrad(p.region, p.tetrad));
  RC_ASSERT(p.r >= orbit.innermost() * (1 - 1e-14));
  RC_ASSERT(p.r <= orbit.outermost() * (1 + 1e-14));
  const double scale = gamma_of(p) * (1 + std::sqrt(2 / p.r));
  RC_ASSERT(std::abs(energy_of(p) - orbit.energy()) <= 1e-12 * scale);
  RC_ASSERT(std::abs(angular_momentum_of(p) - orbit.angular_momentum()) <=
            1e-14 * orbit.angular_momentum());
}

TEST(GeodesicProperty, EveryStateHasTheOrbitsConstants) {
  EXPECT_TRUE(rc::check([] {
    const Thrown thrown = drawn();
    check_constants(thrown.orbit, thrown.orbit.at(thrown.tau));
    check_constants(thrown.orbit, thrown.orbit.at(0));
  }));
}

TEST(GeodesicProperty, TimeAtIsTheInverseOfAt) {
  EXPECT_TRUE(rc::check([] {
    const Thrown thrown = drawn();
    const OrbitPoint p = thrown.orbit.at(thrown.tau);
    const double speed = radial_speed_of(p);
    const double before = thrown.tau - 1e-3 * (1 + std::abs(thrown.tau));
    const auto tau = thrown.orbit.time_at(p.r, speed > 0 ? Leg::kOutward : Leg::kInward, before);
    // A rounding of r moves tau by that over the speed; at a turning point the leg itself is
    // rounded.
    const double lost = 1e-15 * p.r / std::abs(speed);
    if (lost > 1e-6) return;
    RC_ASSERT(tau.has_value());
    RC_ASSERT(std::abs(double(*tau - thrown.tau)) <=
              1e-13 * (1 + std::abs(thrown.tau)) + 10 * lost);
  }));
}

using Motion = std::array<double, 3>;  // r, dr/dtau, azimuth

// r'' = -1/r^2 + L^2/r^3 - 3 L^2/r^4, half the slope of E^2 - (1 - 2/r)(1 + L^2/r^2).
Motion integrated(const OrbitPoint& from, double momentum, double span) {
  using Stepper = odeint::runge_kutta_fehlberg78<Motion>;
  Motion y{from.r, radial_speed_of(from), from.azimuth};
  const auto motion = [l2 = momentum * momentum, momentum](const Motion& at, Motion& rate, double) {
    const double w = 1 / at[0];
    rate = {at[1], w * w * (-1 + l2 * w * (1 - 3 * w)), momentum * w * w};
  };
  odeint::integrate_adaptive(odeint::make_controlled<Stepper>(1e-14, 1e-13), motion, y, 0.0, span,
                             span / 100);
  return y;
}

// Over a time in which r or the azimuth changes by about as much as they are, forward or back.
TEST(GeodesicProperty, StatesFollowTheEquationOfMotion) {
  EXPECT_TRUE(rc::check([] {
    const Thrown thrown = drawn();
    const Geodesic& orbit = thrown.orbit;
    const OrbitPoint from = orbit.at(thrown.tau);
    const double left = thrown.tau > 0 ? orbit.death() - thrown.tau : thrown.tau - orbit.birth();
    const double span =
        std::min({0.5 * left, std::pow(from.r, 1.5), from.r / std::abs(radial_speed_of(from)),
                  2 * from.r * from.r / orbit.angular_momentum()}) *
        (thrown.tau > 0 ? 1 : -1);
    const OrbitPoint to = orbit.at(thrown.tau + span);
    const Motion wanted = integrated(from, orbit.angular_momentum(), span);
    // The start's speed is a difference of the celerity and s gamma.
    const double start = 1e-15 * gamma_of(from) * (1 + std::sqrt(2 / from.r)) * std::abs(span);
    const auto rate = [&orbit](const OrbitPoint& p) {
      return (std::abs(radial_speed_of(p)) + orbit.angular_momentum() / p.r) / p.r;
    };
    const double rounded = 1e-15 * std::abs(thrown.tau) * std::max(rate(from), rate(to));
    // The steps' own errors add up to some 2e-10.
    const double bound = 1e-9 + 100 * (start / std::min(to.r, from.r) + rounded);
    RC_ASSERT(std::abs(to.r / wanted[0] - 1) <= bound);
    RC_ASSERT(std::abs(to.azimuth - wanted[2]) <= bound);
  }));
}

}  // namespace
}  // namespace domefall
