#include "pipeline/light/integrated_ray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/pipeline/light/reference_rays.h"

namespace domefall {
namespace {

struct Method {
  Integrator integrator;
  const char* name;
};

constexpr Method kMethods[] = {{Integrator::kPaperRk4, "PaperRk4"},
                               {Integrator::kFullDopri5, "FullDopri5"},
                               {Integrator::kFullRkf78, "FullRkf78"},
                               {Integrator::kBinetDopri5, "BinetDopri5"},
                               {Integrator::kBinetRkf78, "BinetRkf78"}};

// Light seen at delta by the observers of rays.csv.
PhotonAtObserver photon_of(const std::string& observer, double r, double delta) {
  const double s = std::sqrt(2 / r), c = std::cos(delta), l = r * std::sin(delta);
  const Region falling = r < 2 ? Region::kII : Region::kI;
  if (observer == "rain") return {falling, r, 1 - s * c, l, c - s};
  if (observer == "outgoing") return {r < 2 ? Region::kIV : Region::kI, r, 1 + s * c, l, c + s};
  if (observer == "static") {
    const double lapse = std::sqrt(1 - 2 / r);
    return {Region::kI, r, lapse, l, lapse * c};
  }
  const double lapse = std::sqrt(2 / r - 1);
  if (observer == "T_II") return {Region::kII, r, -lapse * c, l, -lapse};
  return {Region::kIV, r, -lapse * c, l, lapse};
}

std::string origin_name(std::optional<SkyRegion> origin) {
  return origin ? name_of(*origin) : "undecided";
}

std::string row_text(const ReferenceRay& row) {
  return row.observer + " r=" + std::to_string(row.r) + " delta=" + std::to_string(row.delta) +
         " " + row.edge + " " + std::to_string(row.offset);
}

std::vector<ReferenceRay> rows_off_the_edges(double distance) {
  std::vector<ReferenceRay> rows;
  for (const char* observer : {"rain", "static", "outgoing", "T_II", "T_IV"})
    for (const ReferenceRay& row : reference_rays(observer))
      if (row.edge.empty() || std::abs(row.offset) > 0.99 * distance) rows.push_back(row);
  return rows;
}

// How far phi may be off.  A step errs by at most `tolerance` of the state, which is about what
// turning the look direction by that angle does: it moves phi by |slope| times it, and phi's own
// share comes on top.  Few steps err near their limit and signs differ: the largest sum measured is
// 3.6 times one step's bound (1.7 at the tolerances below).  To that comes what rounding does to
// the photon's components, worst in sqrt(1 - 2/r) beside the horizon.
double allowed_error(const ReferenceRay& row, double tolerance) {
  constexpr double kSumOfSteps = 4;
  const double rounding = 8 * std::numeric_limits<double>::epsilon() *
                          (1 + (row.observer == "rain" ? 0 : 1 / std::abs(1 - 2 / row.r)));
  return (kSumOfSteps * tolerance + rounding) * (row.phi + std::abs(row.slope));
}

class EachIntegrator : public testing::TestWithParam<Method> {
 protected:
  static IntegratedRay follow(const PhotonAtObserver& photon, double tolerance) {
    return integrate_ray(photon, GetParam().integrator, tolerance);
  }
};

// The distance to an edge is 1000 times the tolerance, where the origin is in no doubt.
TEST_P(EachIntegrator, FindsOriginAndAzimuthOfEveryReferenceRay) {
  for (double tolerance : {1e-6, 1e-9}) {
    const std::vector<ReferenceRay> rows = rows_off_the_edges(1000 * tolerance);
    ASSERT_GT(rows.size(), 400u);
    for (const ReferenceRay& row : rows) {
      const IntegratedRay ray = follow(photon_of(row.observer, row.r, row.delta), tolerance);
      ASSERT_EQ(origin_name(ray.origin), row.origin) << row_text(row);
      EXPECT_NEAR(ray.phi, row.phi, allowed_error(row, tolerance)) << row_text(row);
    }
  }
}

// The median ray is better than the tolerance, and 99 of 100 better than 1000 times it, the slope
// of rays 1e-3 beside an edge.
TEST_P(EachIntegrator, ErrsLessAsTheToleranceFalls) {
  const std::vector<ReferenceRay> rows = rows_off_the_edges(1e-3);
  for (double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < rows.size(); i += 2) {
      const ReferenceRay& row = rows[i];
      const IntegratedRay ray = follow(photon_of(row.observer, row.r, row.delta), tolerance);
      errors.push_back(std::abs(ray.phi - row.phi));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], tolerance);
    EXPECT_LT(errors[errors.size() * 99 / 100], 1000 * tolerance);
  }
}

// Without energy dphi = dr / sqrt(2 r - r^2): t is constant, and the ray from region II passes the
// sphere U = V = 0.
TEST_P(EachIntegrator, AgreesWithTheClosedFormOfRaysWithoutEnergy) {
  constexpr double kPi = std::numbers::pi;
  for (double r : {0.01, 0.3, 0.5, 1.0, 1.7, 1.99, 1.999999}) {
    const double lapse = std::sqrt(2 / r - 1), from_singularity = std::asin(r - 1) + kPi / 2;
    const IntegratedRay four = follow({Region::kIV, r, 0, r, lapse}, 1e-10);
    EXPECT_EQ(four.origin, SkyRegion::kIV);
    EXPECT_NEAR(four.phi, from_singularity, 1e-8) << r;
    const IntegratedRay two = follow({Region::kII, r, 0, r, -lapse}, 1e-10);
    EXPECT_EQ(two.origin, SkyRegion::kIV);
    EXPECT_NEAR(two.phi, 2 * kPi - from_singularity, 1e-8) << r;
  }
}

TEST_P(EachIntegrator, RadialRaysSweepNothing) {
  const auto expect = [](Region region, double r, double energy, double radial, SkyRegion origin) {
    const IntegratedRay ray = follow({region, r, energy, 0, radial}, 1e-6);
    EXPECT_EQ(ray.origin, origin) << region_name(region) << " " << r << " " << energy;
    EXPECT_EQ(ray.phi, 0);
  };
  for (double r : {2.0, 2.000001, 3.0, 50.0, 1e8}) {
    expect(Region::kI, r, 1, -1, SkyRegion::kI);
    expect(Region::kI, r, 1, 1, SkyRegion::kIV);
    expect(Region::kIII, r, -1, -1, SkyRegion::kIII);
    expect(Region::kIII, r, -1, 1, SkyRegion::kIV);
  }
  for (double r : {1e-6, 0.1, 0.5, 1.0, 1.999999, 2.0}) {
    expect(Region::kII, r, 1, -1, SkyRegion::kI);
    expect(Region::kII, r, -1, -1, SkyRegion::kIII);
    expect(Region::kIV, r, 1, 1, SkyRegion::kIV);
    expect(Region::kIV, r, -1, 1, SkyRegion::kIV);
  }
}

// phi -> b/r towards the sky; towards the singularity phi ~ b^(1/3), too small to name here.
TEST_P(EachIntegrator, NearlyRadialRaysNeitherOverflowNorVanish) {
  for (double l : {1e-8, 1e-30, 1e-100, 1e-200, 1e-308}) {
    const IntegratedRay out = follow({Region::kI, 10, 1, l, -1}, 1e-9);
    EXPECT_EQ(out.origin, SkyRegion::kI);
    EXPECT_NEAR(out.phi, l < 1e-60 ? 0 : l / 10, 1e-7 * l) << l;
    const IntegratedRay in = follow({Region::kI, 10, 1, l, 1}, 1e-9);
    EXPECT_EQ(in.origin, SkyRegion::kIV) << l;
    EXPECT_GE(in.phi, 0);
    EXPECT_LT(in.phi, 4 * std::cbrt(l)) << l;
    EXPECT_EQ(in.phi > 0, l > 1e-60);
  }
}

TEST_P(EachIntegrator, OnlyRatiosOfThePhotonsComponentsMatter) {
  const PhotonAtObserver k = photon_of("rain", 1.2, 2.0);
  const double phi = follow(k, 1e-8).phi;
  for (double factor : {0x1p-900, 0x1p-3, 0x1p900})
    EXPECT_EQ(
        follow({k.region, k.r, factor * k.energy, factor * k.angular_momentum, factor * k.radial},
               1e-8)
            .phi,
        phi);
}

TEST_P(EachIntegrator, RegionThreeIsTheMirrorOfRegionOne) {
  for (double r : {2.0001, 2.9, 3.1, 20.0})
    for (double delta : {0.2, 1.0, 1.7, 3.0}) {
      PhotonAtObserver k = photon_of("rain", r, delta);
      const IntegratedRay one = follow(k, 1e-9);
      k.region = Region::kIII;
      k.energy = -k.energy;
      const IntegratedRay three = follow(k, 1e-9);
      EXPECT_EQ(one.origin == SkyRegion::kI, three.origin == SkyRegion::kIII);
      EXPECT_EQ(one.origin == SkyRegion::kIV, three.origin == SkyRegion::kIV);
      EXPECT_NEAR(one.phi, three.phi, 1e-12 * (1 + one.phi));
    }
}

// The rain observer at r = 2, by either name of the place, sees what one 1e-9 above it sees.
TEST_P(EachIntegrator, RainAtTheHorizonSeesWhatRainBesideItSees) {
  for (double delta : {0.3, 0.6, 0.9, 1.5, 2.5, 3.1}) {
    const IntegratedRay beside = follow(photon_of("rain", 2 + 1e-9, delta), 1e-9);
    PhotonAtObserver k = photon_of("rain", 2, delta);
    for (Region region : {Region::kI, Region::kII}) {
      k.region = region;
      const IntegratedRay at = follow(k, 1e-9);
      EXPECT_EQ(at.origin, beside.origin) << delta;
      EXPECT_NEAR(at.phi, beside.phi, 1e-6) << delta;
    }
  }
}

// On the light circle the end is rounding's choice or none; it must come, and be finite if decided.
TEST_P(EachIntegrator, TheLightCircleEndsWithinTheBudget) {
  const double l = std::sqrt(27.0);
  for (double radial : {0.0, 1e-16, -1e-16, 1e-13, -1e-13}) {
    const IntegratedRay ray = follow({Region::kI, 3, 1, l, radial}, 1e-9);
    EXPECT_LE(ray.steps, kRayStepBudget);
    EXPECT_EQ(std::isfinite(ray.phi), ray.origin != std::nullopt);
    if (std::abs(radial) >= 1e-13) {
      EXPECT_EQ(ray.origin, radial < 0 ? SkyRegion::kI : SkyRegion::kIV);
      EXPECT_GT(ray.phi, 25);  // ln(1/1e-13) = 30 radians of whirling, less what the exit saves
    }
  }
}

TEST_P(EachIntegrator, LightAlongTheHorizonHasNoOrigin) {
  const IntegratedRay ray = follow({Region::kII, 2, 0, 0, 0}, 1e-6);
  EXPECT_EQ(ray.origin, std::nullopt);
  EXPECT_TRUE(std::isnan(ray.phi));
  EXPECT_EQ(ray.steps, 0);
}

INSTANTIATE_TEST_SUITE_P(With, EachIntegrator, testing::ValuesIn(kMethods),
                         [](const auto& method) { return std::string(method.param.name); });

}  // namespace
}  // namespace domefall
