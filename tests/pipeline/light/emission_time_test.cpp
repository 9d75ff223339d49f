#include "pipeline/light/emission_time.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>

#include "pipeline/light/emission_time_table.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "tests/pipeline/light/singularity_rays.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;
namespace odeint = boost::numeric::odeint;

// t at emission by following the ray backward: y = (r, p = dr/dlambda, u or v), the parameter of
// the steps sigma with d lambda = -r^2 d sigma.  E > 0.
class FollowedRay {
 public:
  FollowedRay(const NullRay& ray, const RayInvariants& k)
      : e_(std::abs(k.energy)), l_(k.angular_momentum), y_{ray.at.r, k.radial, 0} {
    if (ray.at.above_horizon < 0) y_[1] = std::abs(k.radial) * (ray.outgoing ? 1 : -1);
  }

  // From u at the observer, or from v if the ray has turned.
  double time() {
    double switched = 0;
    if (y_[1] < 0) {
      follow([](const State& y) { return y[1] >= 0; });
      switched = -2 * Schwarzschild::tortoise(y_[0]);  // there v becomes u
    }
    follow([](const State& y) { return y[0] < kEnd; });
    return y_[2] + switched - y_[0] * y_[0] / 4;  // the rest of the way, du = r dr/2
  }

 private:
  using State = std::array<double, 3>;
  static constexpr double kEnd = 1e-4;

  template <class Done>
  void follow(Done done) {
    const auto rates = [this](const State& y, State& dy, double) {
      dy[0] = -y[0] * y[0] * y[1];
      dy[1] = -l_ * l_ * (y[0] - 3) / (y[0] * y[0]);
      dy[2] = -l_ * l_ / (e_ + std::abs(y[1]));
    };
    odeint::runge_kutta_fehlberg78<State> step;
    double h = 1e-3 / l_;
    for (int k = 0; k < 4000000 && !done(y_); ++k) {
      // Short steps where the singularity is near: there sigma that is left goes like sqrt(r).
      h = 2e-3 / l_ * std::min(1.0, std::sqrt(y_[0]));
      if (y_[1] < 0) {  // end on the turning point: Newton's last steps
        const double rate = -l_ * l_ * (y_[0] - 3) / (y_[0] * y_[0]);
        if (y_[1] + rate * h > 0) h = -y_[1] / rate * 1.0000001 + 1e-12;
      }
      step.do_step(rates, y_, 0.0, h);
    }
  }

  double e_, l_;
  State y_;
};

// As good as radial rays have no digits of their azimuth to spare.
constexpr NearAxis kOffTheAxis{1e-10, 1e-6};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const long double r :
       {1e-6L, 1e-3L, 0.05L,      0.5L, 1.0L, 1.7L, 1.999L, 2 - 1e-9L, 2.0L, 2 + 1e-9L, 2 + 1e-6L,
        2.5L,  2.9L,  3 - 1e-10L, 3.0L, 3.1L, 6.0L, 30.0L,  1e3L,      1e5L, 1e8L})
    for (const bool outgoing : {false, true}) all.push_back({Radius(r), outgoing});
  return all;
}

TEST(EmissionTime, IsThatOfARayFollowedBackward) {
  for (const Case& c :
       {Case{0.3, false}, Case{1.2, false}, Case{1.9, false}, Case{2.5, false}, Case{2.9, false},
        Case{8.0, false}, Case{0.3, true}, Case{1.7, true}, Case{2.6, true}, Case{8.0, true}}) {
    Rays rays(c, 3, kOffTheAxis, 1e-4);
    for (int n = 0; n < tries(20, 4); ++n) {
      const NullRay ray = rays.next();
      const RayInvariants k = invariants(ray);
      const double b = k.angular_momentum / std::abs(k.energy);
      if (b < 0.1 || b > 1e3) continue;  // below, the last stretch is no du = r dr/2 yet
      const bool inside = c.at.above_horizon < 0;
      const bool turned = inside ? !c.outgoing : k.radial < 0;
      const double star = Schwarzschild::tortoise(c.at);
      const double followed = FollowedRay(ray, k).time() + (turned ? star : -star);  // from t
      const double expected = (k.energy < 0 ? -followed : followed) - (c.outgoing ? -star : star);
      EXPECT_NEAR(exact_emission_time(ray), expected, 1e-9 * (1 + std::abs(expected)))
          << name(c) << " alpha " << alpha_of(ray) << " b " << b;
    }
  }
}

// Hamilton and Jacobi: rays that end in one place and differ in b have dt = b dphi between them.
TEST(EmissionTime, ChangesWithTheAzimuthByTheImpactParameter) {
  for (const Case& c : cases()) {
    Rays rays(c, 4, kOffTheAxis);
    for (int n = 0; n < 100; ++n) {
      const NullRay ray = rays.next();
      const RayInvariants k = invariants(ray);
      const double b = k.angular_momentum / k.energy;
      if (std::abs(b) > 1e3 || std::abs(b) < 1e-3) continue;
      const double h = 1e-3 * smooth_over(ray);
      const auto time = [&](double steps) { return exact_emission_time(turned(ray, steps * h)); };
      const double slope = (8 * (time(1) - time(-1)) - (time(2) - time(-2))) / (12 * h);
      const double expected = -b * exact_slope(ray);
      const double noise = 1e-11 * (1 + std::abs(time(0))) / h;
      EXPECT_NEAR(slope, expected, 1e-5 * std::abs(expected) + noise)
          << name(c) << " alpha " << alpha_of(ray) << " b " << b;
    }
  }
}

TEST(EmissionTime, OfNoEnergyIsTheObserversOwnAndOddInEnergy) {
  for (const double r : {0.01, 0.7, 1.5, 1.99})
    for (const bool outgoing : {false, true}) {
      const double zero = kappa(r, {outgoing, true}),
                   own = Schwarzschild::tortoise(r) * (outgoing ? 1 : -1);
      EXPECT_NEAR(exact_emission_time(ray_of_tangent(r, zero, outgoing)), own, 1e-9);
      const double end = outgoing ? 5 : tan_half_critical(r, Critical::kFirst) / zero;
      for (const double part : {1e-6, 1e-3, 0.1, 0.3, 0.6, 0.99}) {
        const double ratio = std::pow(end, part);
        const double above = exact_emission_time(ray_of_tangent(r, zero * ratio, outgoing));
        const double below = exact_emission_time(ray_of_tangent(r, zero / ratio, outgoing));
        EXPECT_NEAR(above + below, 2 * own, 1e-9 * (1 + std::abs(above))) << r << " " << part;
        // In IV light with E > 0 loses t on its way; into II it comes by way of the outside, where
        // it gains.
        EXPECT_EQ(above > own, outgoing) << r << " " << part;
      }
    }
}

TEST(EmissionTime, RunsOnThroughTheHorizonForTheRainObserver) {
  for (const double alpha : {0.2, 0.4, 0.6, 0.72}) {
    const double on = exact_emission_time(ray_at(2.0, alpha));
    for (const long double away : {1e-6L, 1e-9L, 1e-12L}) {
      const auto a = static_cast<double>(away);
      EXPECT_NEAR(exact_emission_time(ray_at(Radius(2 + away), alpha)), on, 200 * a + 1e-10);
      EXPECT_NEAR(exact_emission_time(ray_at(Radius(2 - away), alpha)), on, 200 * a + 1e-10);
    }
  }
}

TEST(EmissionTime, OfRadialLightIsItsU) {
  for (const double r : {2.5, 6.0, 20.0, 1e6}) {
    EXPECT_NEAR(exact_emission_time(ray_at(r, 0)), -2 * Schwarzschild::tortoise(r), 1e-9 * r);
    EXPECT_NEAR(exact_emission_time(ray_at(r, 1e-9)), -2 * Schwarzschild::tortoise(r), 1e-9 * r);
    EXPECT_EQ(exact_emission_time(ray_at(r, std::numbers::pi_v<long double>, {true, false})), 0);
  }
  EXPECT_NEAR(exact_emission_time(ray_at(0.5, pi, {true, false})), 0, 1e-9);
  EXPECT_NEAR(exact_emission_time(ray_at(0.5, 0, {true, false})), 2 * Schwarzschild::tortoise(0.5),
              1e-9);
}

TEST(EmissionTime, OfCirclingLightIsLongAgo) {
  EXPECT_EQ(exact_emission_time(ray_off_edge(6, Critical::kFirst, 0)), -HUGE_VAL);
  EXPECT_EQ(exact_emission_time(ray_off_edge(1, Critical::kFirst, 0)), -HUGE_VAL);
  EXPECT_EQ(exact_emission_time(ray_off_edge(1, Critical::kSecond, 0)), HUGE_VAL);
}

// The rest beside the azimuth's share stays as it is through ten orders of magnitude.
TEST(EmissionTime, DivergesLikeTheAzimuthNextToAnEdge) {
  const auto rest = [](double r, double offset) {
    const NullRay ray = ray_off_edge(r, Critical::kFirst, -offset);
    return exact_emission_time(ray) + std::sqrt(27) * exact_azimuth(ray);
  };
  for (const double r : {0.2, 1.5, 2.0, 2.7, 3.5, 20.0})
    for (const double offset : {1e-6, 1e-9, 1e-12, 1e-15})
      EXPECT_NEAR(rest(r, offset), rest(r, 1e-16), 1e3 * (1 + r) * offset + 1e-11) << r;
}

TEST(EmissionTimeTable, AgreesWithTheExactTime) {
  for (const Case& c : cases()) {
    const WhiteHoleTable table(c.at, c.outgoing);
    const EmissionTimeTable times(table);
    Rays rays(c, 5, kOffTheAxis);
    double worst = 0, worst_slope = 0;
    NullRay where = ray_at(c.at, 1), where_slope = where;
    for (int n = 0; n < 1000; ++n) {
      const NullRay ray = rays.next();
      const auto place = table.place_of(ray);
      const bool beyond = ray.sin_half > table.lookup().place.zero * ray.cos_half;
      const double slope = std::abs(table.slope(place));
      const auto value = times.at(place, beyond, table.azimuth(place), slope);
      const double exact = exact_emission_time(ray);
      const double error = std::abs(value.time - exact) / (1 + std::abs(exact) * 1e-3);
      if (!(error <= worst)) worst = error, where = ray;
      ASSERT_TRUE(std::isfinite(value.slope));
      const RayInvariants k = invariants(ray);
      const double expected = std::abs(k.angular_momentum / k.energy * slope);
      const double off = std::abs(value.slope - expected) / (expected + 1e-2);
      if (expected < 1e9 && std::abs(k.energy) > 1e-3 * k.angular_momentum && off > worst_slope)
        worst_slope = off, where_slope = ray;
    }
    EXPECT_LT(worst, 1e-5) << name(c) << " alpha " << alpha_of(where) << " gaps " << where.gap_first
                           << " " << where.gap_second;
    EXPECT_LT(worst_slope, 1e-2) << name(c) << " alpha " << alpha_of(where_slope) << " gaps "
                                 << where_slope.gap_first << " " << where_slope.gap_second;
  }
}

}  // namespace
}  // namespace domefall
