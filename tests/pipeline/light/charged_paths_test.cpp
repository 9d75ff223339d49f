// Places and times along rays near a charge, against their orbits by small steps in long double.
#include "pipeline/light/charged_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/charged_azimuth.h"
#include "pipeline/light/ray_orbits.h"
#include "pipeline/light/ray_times.h"
#include "tests/pipeline/light/charged_orbits.h"

namespace domefall {
namespace {

TEST(ChargedPaths, AreTheOrbitsThatAreFollowed) {
  std::mt19937 random(3);
  const auto between = [&random](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
  };
  int compared = 0, past = 0, at_sky = 0;
  for (const double charge : {0.01, 0.5, 0.95, 1.0}) {
    const ChargedHole hole(1, charge);
    for (const double r : {1.2, 2.1, 3.0, 8.0, 40.0}) {
      if (r < hole.inner_horizon()) continue;
      const ChargedPaths paths(hole, r);
      const double f = hole.lapse_squared(r);
      for (int k = 0; k < 40; ++k) {
        // Of region I, with E > 0.
        const double least = f < 0 ? std::sqrt(-f) * 1.001 : 1e-2;
        const Label label = label_of(hole, r, least * std::pow(100 / least, between(0, 1)));
        const double psi = between(0, k % 4 == 0 ? 12 : 4);
        const Followed truth = follow(hole, r, label, psi);
        ChargedPaths::Places found;
        paths.timed(&label.p, &label.e, &psi, 1, found);
        SCOPED_TRACE(testing::Message() << charge << " " << r << " " << label.p << " " << psi);
        if (truth.past || truth.at_sky) {
          const double end = truth.past ? 1e300 : 0;
          EXPECT_NEAR(std::min(found.w[0], 1e300), end, 2e-9 * label.e);
          ++(truth.past ? past : at_sky);
          continue;
        }
        const double loose = 1e-13 * std::exp(psi);
        EXPECT_NEAR(found.w[0], static_cast<double>(truth.w), loose);
        EXPECT_NEAR(found.slope[0], static_cast<double>(truth.slope), loose * (1 + label.e));
        // RK4's own error in steps of w/500.
        if (truth.slope > 0 && truth.w > 0.999 / hole.horizon()) continue;
        EXPECT_NEAR(found.time[0], static_cast<double>(truth.time),
                    1e-9 * (1 + std::abs(static_cast<double>(truth.time))) + 1e3 * loose);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 150);
  EXPECT_GT(past, 50);
  EXPECT_GT(at_sky, 50);
}

// The azimuth to the sky is that of the integral over the quartic.
TEST(ChargedPaths, EndOnTheSkyWhereTheAzimuthEnds) {
  for (const double charge : {0.3, 0.9, 1.0}) {
    const ChargedHole hole(1, charge);
    for (const double r : {2.5, 6.0, 30.0}) {
      const ChargedView view(hole, hole.at(r));
      const ChargedPaths paths(hole, r);
      for (const double offset : {1e-3, 0.03, 0.4, 1.0}) {
        const ChargedRay ray = view.ray_off_edge(Critical::kFirst, offset);
        const Label label = label_of(hole, r, static_cast<double>(ray.sin_half / ray.cos_half));
        const double azimuth = view.azimuth(ray);
        ChargedPaths::Places found;
        for (const double off : {1e-4, -1e-4}) {
          const double psi = azimuth - off;
          paths.find(&label.p, &label.e, &psi, 1, found);
          // Next to the sky w = e psi.
          EXPECT_NEAR(found.w[0], off > 0 ? label.e * off : 0, 1e-9)
              << charge << " " << r << " " << offset;
        }
      }
    }
  }
}

// A charge of 1e-8 changes nothing of 1e-9.
TEST(ChargedPaths, TendToThoseOfAHoleWithoutCharge) {
  const ChargedHole hole(1, 1e-8);
  for (const double r : {1.5, 2.5, 6.0, 30.0}) {
    const ChargedPaths paths(hole, r);
    const Radius at(r);
    for (const double tangent : {0.5, 0.8, 1.5, 4.0}) {
      const double s = std::sqrt(2 / r), in_rain = tangent / (1 + s);
      const double sine = in_rain / std::hypot(1, in_rain), cosine = 1 / std::hypot(1, in_rain);
      const Label label = label_of(hole, r, tangent);
      if (hole.lapse_squared(r) + tangent * tangent <= 0) continue;
      RayOrbits orbits;
      orbits.set(at, false, {&sine, &cosine, nullptr, nullptr}, 1);
      for (const double psi : {0.1, 0.7, 2.0, 3.5}) {
        RayPlaces places;
        double time = 0;
        orbits.find(&psi, places);
        RayTimes(orbits).find(&psi, places, &time);
        ChargedPaths::Places found;
        paths.timed(&label.p, &label.e, &psi, 1, found);
        if (std::isinf(found.w[0]) || found.w[0] == 0) {
          EXPECT_TRUE(places.r[0] < 2 || std::isinf(places.r[0])) << r << " " << tangent;
          continue;
        }
        const double loose = 1e-12 * std::exp(psi);
        EXPECT_NEAR(found.w[0] * places.r[0], 1, loose) << r << " " << tangent << " " << psi;
        EXPECT_NEAR(found.time[0], time, 100 * loose * (1 + std::abs(time)));
      }
    }
  }
}

TEST(ChargedPaths, AreTheSameBitsByEveryInstructionSet) {
  const ChargedHole hole(1, 0.7L);
  const ChargedPaths paths(hole, 9);
  constexpr int kRays = 100;
  ChargedPaths::Column p{}, e{}, psi{};
  for (std::size_t k = 0; k < kRays; ++k) {
    const Label label = label_of(hole, 9, 0.02 * static_cast<double>(k + 1));
    p[k] = label.p, e[k] = label.e, psi[k] = 0.1 * static_cast<double>(k);
  }
  const Simd before = simd_in_use();
  use_simd(Simd::kPortable);
  ChargedPaths::Places plain, wide;
  paths.timed(p.data(), e.data(), psi.data(), kRays, plain);
  for (const Simd level : kEverySimd) {
    if (!processor_has(level)) continue;
    use_simd(level);
    paths.timed(p.data(), e.data(), psi.data(), kRays, wide);
    for (std::size_t k = 0; k < kRays; ++k) {
      EXPECT_EQ(plain.w[k], wide.w[k]);
      EXPECT_EQ(plain.time[k], wide.time[k]);
    }
  }
  use_simd(before);
}

}  // namespace
}  // namespace domefall
