#include "pipeline/light/ray_times.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/emission_time.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_ray.h"
#include "pipeline/spacetime/schwarzschild.h"
#include "tests/pipeline/light/random_rays.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

double time_of(const NullRay& ray, double psi) {
  const RayOrbits orbits = orbits_of({ray});
  RayPlaces places;
  orbits.find(&psi, places);
  double time = 0;
  RayTimes(orbits).find(&psi, places, &time);
  return time;
}

// By Gauss's rule over pieces of psi.
template <class F>
double integral(double to, F f) {
  constexpr int kPieces = 24;
  double sum = 0;
  for (int k = 0; k < kPieces; ++k)
    sum += boost::math::quadrature::gauss<double, 20>::integrate(f, to * k / kPieces,
                                                                 to * (k + 1) / kPieces);
  return sum;
}

// Outside, light passes the time dt = r^2 dpsi/(b (1 - 2/r)).
TEST(RayTimes, AreThoseOfTheMetricOutside) {
  RandomRays random;
  int compared = 0, turned = 0;
  for (int n = 0; n < tries(500, 50); ++n) {
    const Radius at = 2 + random.logarithmic(0.05, 15);
    const NullRay ray = random.ray(at, random.one_in(2));
    const double psi = 0.95 * std::min(random.psi(ray), 8.0);
    const RayInvariants k = invariants(ray);
    const double e = k.energy / k.angular_momentum, least = 2.05;
    bool outside = true;
    const auto rate = [&](double angle) {
      const double r = place_of(ray, angle).r[0];
      outside = outside && r > least;
      return r * r * e / (1 - 2 / r);
    };
    const double passed = integral(psi, rate);
    const RayPlaces there = place_of(ray, psi);
    if (!outside || there.r[0] > 30 * at.r) continue;
    const double star = Schwarzschild::tortoise(there.r[0]) - Schwarzschild::tortoise(at);
    EXPECT_NEAR(time_of(ray, psi), -passed + (ray.outgoing ? -star : star),
                1e-11 * (1 + std::abs(passed) + std::abs(star)))
        << at.r << " " << ray.outgoing << " " << alpha_of(ray) << " " << psi;
    ++compared;
    turned += (there.slope[0] > 0) == (k.radial > 0) ? 1 : 0;
  }
  EXPECT_GT(compared, tries(200, 15));
  EXPECT_GT(turned, tries(20, 0));
}

TEST(RayTimes, AreTheEmissionTimesOfTheSingularityAtItsEnd) {
  RandomRays random;
  int compared = 0;
  for (int n = 0; n < tries(1500, 150); ++n) {
    const Radius at =
        random.one_in(2) ? random.logarithmic(0.3, 8) : 2 + random.logarithmic(1e-6, 1);
    const NullRay ray = random.ray(at, random.one_in(2));
    const RayInvariants k = invariants(ray);
    const double b = k.angular_momentum / std::abs(k.energy);
    if (origin_of(ray) != SkyRegion::kIV || !(b > 0.1 && b < 1000)) continue;
    const double end = exact_azimuth(ray), time = exact_emission_time(ray);
    EXPECT_NEAR(time_of(ray, end * (1 - 1e-12)), time, 1e-9 * std::max(1.0, std::abs(time)))
        << at.r << " " << ray.outgoing << " " << alpha_of(ray);
    ++compared;
  }
  EXPECT_GT(compared, tries(500, 50));
}

// Light that neither turns nor comes from beyond the other horizon: the regular form of the
// integral.
TEST(RayTimes, AreRegularWhereTheirHorizonIsCrossed) {
  RandomRays random;
  for (int n = 0; n < tries(300, 30); ++n) {
    const Radius at = random.logarithmic(0.05, 2);
    const NullRay ray = random.ray(at, false);
    const RayInvariants k = invariants(ray);
    if (origin_of(ray) != SkyRegion::kI || ray.gap_first < 1e-6) continue;
    const double psi = 0.95 * exact_azimuth(ray), e = k.energy / k.angular_momentum;
    const auto rate = [&](double angle) {
      const RayPlaces place = place_of(ray, angle);
      return 1 / (e + place.slope[0] / (place.r[0] * place.r[0]));
    };
    const double time = time_of(ray, psi);
    EXPECT_NEAR(time, -integral(psi, rate), 1e-11 * std::max(1.0, std::abs(time))) << at.r;
  }
}

// Integrators, which share no formula with them.  Near an edge they lose what they have, and near
// the horizon of a static observer there is little to count by.
TEST(RayTimes, AreThoseOfEveryIntegrator) {
  RandomRays random;
  TraceOptions fine;
  fine.tolerance = 1e-11;
  int compared = 0, far_side = 0;
  for (int n = 0; n < tries(300, 30); ++n) {
    const auto observer =
        std::array{TraceObserver::kRain, TraceObserver::kStatic, TraceObserver::kOutgoing,
                   TraceObserver::kTwo, TraceObserver::kFour}[n % 5];
    const bool inside = observer == TraceObserver::kTwo || observer == TraceObserver::kFour;
    const double r = observer == TraceObserver::kStatic
                         ? random.logarithmic(2.1, 50)
                         : random.logarithmic(0.1, inside ? 1.9 : 50);
    const RayRequest ray = ray_at_angle(observer, r, std::numbers::pi * random.unit());
    const TracedRay whole = trace_ray(ray, TraceMethod::kExact);
    const double psi = whole.phi * (0.05 + 0.9 * random.unit());
    if (!(psi > 0.05) || std::abs(whole.slope) > 100) continue;
    const auto place = trace_place(ray, psi, TraceMethod::kTable);
    ASSERT_TRUE(place);
    far_side += std::abs(place->null_time) > 20 ? 1 : 0;
    for (const NamedTraceMethod& by : kTraceMethods) {
      if (!is_integrator(by.method)) continue;
      const auto found = trace_place(ray, psi, by.method, fine);
      ASSERT_TRUE(found) << by.name;
      EXPECT_NEAR(found->null_time, place->null_time,
                  1e-7 * std::max(1.0, std::abs(place->null_time)))
          << by.name << " " << n % 5 << " r=" << r << " delta=" << double(ray.delta)
          << " psi=" << psi << " of " << whole.phi;
    }
    ++compared;
  }
  EXPECT_GT(compared, tries(200, 15));
  EXPECT_GT(far_side, tries(10, 0));
}

// Rays that turn: the regular coordinate is that of the horizon on which the observer is.
TEST(RayTimes, OfAnObserverOnTheHorizonAreThoseOfEveryIntegrator) {
  TraceOptions fine;
  fine.tolerance = 1e-11;
  for (const TraceObserver observer : {TraceObserver::kRain, TraceObserver::kOutgoing})
    for (const double delta : {0.5, 0.7, 1.3, 2.4}) {
      const RayRequest ray = ray_at_angle(observer, 2.0, delta);
      const double phi = trace_ray(ray, TraceMethod::kExact).phi;
      for (const double psi : {0.3 * phi, 0.8 * phi}) {
        const auto place = trace_place(ray, psi, TraceMethod::kTable);
        ASSERT_TRUE(place);
        for (const NamedTraceMethod& by : kTraceMethods) {
          const auto found = trace_place(ray, psi, by.method, fine);
          ASSERT_TRUE(found) << by.name;
          EXPECT_NEAR(found->null_time, place->null_time,
                      1e-6 * std::max(1.0, std::abs(place->null_time)))
              << by.name << " " << static_cast<int>(observer) << " " << delta << " " << psi;
        }
      }
    }
}

TEST(RayTimes, VanishAtTheObserverAndCountTheTurnsOfACircle) {
  for (const double r : {0.5, 1.9, 2.0, 2.5, 3.0, 10.0, 1e5})
    for (const double alpha : {0.1, 1.0, 2.0, 3.0})
      EXPECT_NEAR(time_of(ray_at(r, alpha), 0), 0, 1e-12 * r) << r << " " << alpha;
  const NullRay circle = ray_off_edge(3.0, Critical::kFirst, 0);
  EXPECT_NEAR(time_of(circle, 6), -6 * std::sqrt(27.0), 1e-5);
}

TEST(RayTimes, AreTheSameBitsByEveryInstructionSet) {
  RandomRays random;
  const Simd before = simd_in_use();
  for (int observer = 0; observer < 40; ++observer) {
    const Radius at = random.radius();
    const auto run = random.run(at, observer % 2 == 1, 101);
    std::vector<double> plain(run.rays.size()), wide(run.rays.size());
    const auto find = [&](Simd level, std::vector<double>& times) {
      use_simd(level);
      const RayOrbits orbits = orbits_of(run.rays);
      RayPlaces places;
      orbits.find(run.psi.data(), places);
      RayTimes(orbits).find(run.psi.data(), places, times.data());
    };
    find(Simd::kPortable, plain);
    for (const double time : plain) EXPECT_FALSE(std::isnan(time));
    for (const Simd level : kEverySimd) {
      if (!processor_has(level)) continue;
      find(level, wide);
      EXPECT_EQ(std::memcmp(wide.data(), plain.data(), sizeof(double) * run.rays.size()), 0);
    }
  }
  use_simd(before);
}

}  // namespace
}  // namespace domefall
