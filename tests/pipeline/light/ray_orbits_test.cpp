#include "pipeline/light/ray_orbits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/light/exact_azimuth.h"
#include "pipeline/light/ray_position.h"
#include "tests/pipeline/light/random_rays.h"
#include "tests/pipeline/light/reference_rays.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(RayOrbits, FindTheReferenceRows) {
  int rows = 0;
  for (const auto& [line, r, delta, psi, there] : reference_places()) {
    const NullRay ray = ray_at(Radius(std::stold(r)), delta);
    const RayPlaces place = place_of(ray, psi);
    const double drift = std::abs(place.slope[0]) * 4e-16 / there;
    EXPECT_NEAR(place.r[0] / there, 1, 1e-13 + drift * std::max(1.0, psi)) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 224);
}

TEST(RayOrbits, AgreeWithTheClosedFormForAHundredThousandRandomRays) {
  RandomRays random;
  for (int observer = 0; observer < tries(800, 40); ++observer) {
    const Radius at = random.radius();
    const bool outgoing = random.one_in(2);
    const auto [rays, psi] = random.run(at, outgoing, RayOrbits::kSize);
    const RayPlaces places = places_of(rays, psi);
    for (int k = 0; k < RayOrbits::kSize; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double exact = exact_position(rays[i], psi[i]).value_or(kInfinite);
      const double drift = std::abs(places.slope[i]) / exact * std::max(1.0, psi[i]);
      ASSERT_NEAR(places.r[i] / exact, 1, 1e-13 + 2e-15 * drift)
          << at.r << " " << outgoing << " " << alpha_of(rays[i]) << " " << rays[i].gap_first << " "
          << rays[i].gap_second << " " << psi[i];
    }
  }
}

TEST(RayOrbits, HaveTheSlopeOfTheOrbitsEquation) {
  RandomRays random;
  for (int n = 0; n < tries(3000, 300); ++n) {
    const NullRay ray = random.ray(random.radius(), random.one_in(2));
    const double psi = random.psi(ray), r = place_of(ray, psi).r[0];
    const double slope = place_of(ray, psi).slope[0];
    const RayInvariants k = invariants(ray);
    const double e = k.energy / k.angular_momentum, w = 1 / r;
    const double square = e * e - w * w * (1 - 2 * w);
    const double size = e * e + w * w + 2 * w * w * w;
    EXPECT_NEAR(slope * slope * w * w * w * w / size, square / size, 1e-10)
        << ray.at.r << " " << psi;
    // It grows or falls as the place does a little later, unless that is beyond a turning point.
    const double step = 1e-6 * psi, later = place_of(ray, psi + step).r[0];
    if (square > 1e-3 * size && std::isfinite(later) && later > 0) {
      EXPECT_EQ(later > r, slope > 0) << ray.at.r << " " << psi;
    }
  }
}

TEST(RayOrbits, BeginAtTheObserverAndEndOnASkyOrInTheSingularity) {
  for (const double r : {1e-3, 1.0, 2.0, 2.5, 3.0, 4.0, 1e6})
    for (const bool outgoing : {false, true})
      for (const double alpha : {1e-3, 0.5, 1.5, 3.0}) {
        const NullRay ray = ray_at(r, alpha, {outgoing, false});
        EXPECT_NEAR(place_of(ray, 0).r[0], r, 1e-13 * r) << alpha;
        const bool sky = origin_of(ray) != SkyRegion::kIV;
        const RayPlaces end = place_of(ray, exact_azimuth(ray) * (1 + 1e-12));
        EXPECT_EQ(end.r[0], sky ? kInfinite : 0) << r << " " << alpha;
        EXPECT_EQ(end.slope[0], 0);
      }
}

TEST(RayOrbits, OfARadialRayEndsAtOnceAndOfACriticalOneNever) {
  EXPECT_EQ(place_of(ray_at(10, 0), 1e-300).r[0], 0);
  EXPECT_EQ(place_of(ray_at(10, polar_angle(0).reversed()), 1e-300).r[0], kInfinite);
  for (const double r : {0.5, 2.0, 2.5, 3.0, 10.0})
    EXPECT_NEAR(place_of(ray_off_edge(r, Critical::kFirst, 0), 200).r[0], 3, 1e-14) << r;
}

TEST(RayOrbits, MakeTheGapsThatAreNotGiven) {
  const NullRay ray = ray_at(10, 1.0);
  RayOrbits orbits;
  orbits.set(10, false, {&ray.sin_half, &ray.cos_half}, 1);
  RayPlaces places;
  const double psi = 1;
  orbits.find(&psi, places);
  EXPECT_NEAR(places.r[0], place_of(ray, psi).r[0], 1e-13);
}

TEST(RayOrbits, AreTheSameBitsByEveryInstructionSet) {
  RandomRays random;
  const Simd before = simd_in_use();
  for (int observer = 0; observer < 40; ++observer) {
    const Radius at = random.radius();
    const auto [rays, psi] = random.run(at, observer % 2 == 1, 101);
    use_simd(Simd::kPortable);
    const RayPlaces plain = places_of(rays, psi);
    for (const Simd level : kEverySimd) {
      if (!processor_has(level)) continue;
      use_simd(level);
      const RayPlaces wide = places_of(rays, psi);
      EXPECT_EQ(std::memcmp(wide.r.data(), plain.r.data(), sizeof(double) * rays.size()), 0);
      EXPECT_EQ(std::memcmp(wide.slope.data(), plain.slope.data(), sizeof(double) * rays.size()),
                0);
    }
  }
  use_simd(before);
}

}  // namespace
}  // namespace domefall
