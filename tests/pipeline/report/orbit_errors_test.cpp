#include "pipeline/report/orbit_errors.h"

#include <gtest/gtest.h>

#include <map>

namespace domefall {
namespace {

const std::vector<OrbitErrorRow>& quick() {
  static const std::vector<OrbitErrorRow> rows = measure_orbits(true);
  return rows;
}

OrbitErrorRow orbit_row(const std::string& orbit, const std::string& method, double tolerance) {
  for (const OrbitErrorRow& row : quick())
    if (row.orbit.find(orbit) == 0 && row.method == method && row.tolerance == tolerance)
      return row;
  ADD_FAILURE() << orbit << ", " << method << ", " << tolerance << " is not measured";
  return {};
}

// The bounds are a few last bits of terms up to gamma^2 = 31 (at 3.1 M) and of an angular momentum
// of 9.8.
TEST(OrbitErrors, OfClosedFormsLeaveEnergyAngularMomentumAndNormAlone) {
  int seen = 0;
  for (const OrbitErrorRow& row : quick()) {
    if (row.method != "closed form") continue;
    ++seen;
    EXPECT_LT(row.energy_drift, 1e-14) << row.orbit;
    EXPECT_LT(row.angular_momentum_drift, 1e-14) << row.orbit;
    EXPECT_LT(row.norm_drift, 1e-14) << row.orbit;
  }
  EXPECT_EQ(seen, 7);
}

// An azimuth of 100 turns has an ulp of 1.1e-13.  Near the singularity r^(3/2) is the difference of
// two numbers of 164 with an ulp of 2.8e-14, and 3e-5 is left.
TEST(OrbitErrors, OfClosedFormsInPlaceAreInTheLastBits) {
  for (const OrbitErrorRow& row : quick()) {
    if (row.method != "closed form") continue;
    EXPECT_LT(row.phi_error, 3e-13) << row.orbit;
    EXPECT_LT(row.r_error, row.orbit.starts_with("fall") ? 2e-9 : 1e-15) << row.orbit;
  }
  EXPECT_GT(orbit_row("circular at 3.1 M, 3", "closed form", 0).norm_drift, 0) << "with 50 digits";
}

// Next to a singularity the rounding of tau matters.  It is 7e-15 M at the end of the fall, where
// 2e-9 M are left, since the time left goes like r^(5/2).  It is 1e-16 of 3e-6 M at r = 0.01 M on
// the way out.  gamma^2 is up to 1.5e7.
TEST(OrbitErrors, OfQuadraturesAreInTheLastBitsToo) {
  int seen = 0;
  for (const OrbitErrorRow& row : quick()) {
    if (row.method != "quadrature") continue;
    ++seen;
    EXPECT_LT(row.energy_drift, 1e-12) << row.orbit;
    EXPECT_LT(row.angular_momentum_drift, 1e-14) << row.orbit;
    const bool falls = row.orbit.starts_with("fall"), rises = row.orbit.starts_with("from 0.01");
    EXPECT_LT(row.norm_drift, falls ? 1e-8 : 1e-11) << row.orbit;
    EXPECT_LT(row.r_error, falls ? 1e-5 : rises ? 1e-10 : 1e-12) << row.orbit;
    EXPECT_LT(row.phi_error, falls ? 1e-6 : rises ? 1e-11 : 2e-12) << row.orbit;
  }
  EXPECT_EQ(seen, 6);
}

// The error of a step grows 1e4-fold while the orbit whirls, and becomes an error in place.
TEST(OrbitErrors, OfIntegrationsGrowInAWhirl) {
  for (const char* method : {"dopri5", "fehlberg78"})
    EXPECT_GT(orbit_row("whirl", method, 1e-9).phi_error,
              100 * orbit_row("bound", "quadrature", 0).phi_error)
        << method;
}

// The integrations check the closed forms in turn: they share no formula, and come to the same
// places.
TEST(OrbitErrors, OfIntegrationsFallWithTheTolerance) {
  for (const char* method : {"dopri5", "fehlberg78"}) {
    const OrbitErrorRow coarse = orbit_row("circular at 10 M", method, 1e-6),
                        fine = orbit_row("circular at 10 M", method, 1e-9);
    EXPECT_LT(fine.r_error, coarse.r_error / 100) << method;
    EXPECT_LT(fine.phi_error, coarse.phi_error / 100) << method;
    EXPECT_LT(fine.energy_drift, coarse.energy_drift / 100) << method;
    EXPECT_LT(fine.angular_momentum_drift, coarse.angular_momentum_drift / 100) << method;
    EXPECT_LT(fine.norm_drift, coarse.norm_drift / 100) << method;
    EXPECT_LT(fine.r_error, 1e-5) << method;
    EXPECT_LT(fine.phi_error, 1e-3) << method;
    EXPECT_LT(orbit_row("fall", method, 1e-9).r_error, orbit_row("fall", method, 1e-6).r_error / 10)
        << method;
  }
}

// Below 6 M a circle is unstable, so the error of a step grows without end.
TEST(OrbitErrors, OfIntegrationsGrowOnAnUnstableCircle) {
  for (const char* method : {"dopri5", "fehlberg78"}) {
    const OrbitErrorRow stable = orbit_row("circular at 10 M", method, 1e-9),
                        unstable = orbit_row("circular at 3.1 M", method, 1e-9);
    EXPECT_GT(unstable.r_error, 1000 * stable.r_error) << method << ", after 3 turns against 100";
    EXPECT_LT(unstable.energy_drift, 1e-6) << "its constants do not show it";
  }
}

TEST(OrbitErrors, AreGivenForEachOrbitByEachMethod) {
  std::map<std::string, int> rows;
  for (const OrbitErrorRow& row : quick()) {
    ++rows[row.orbit];
    EXPECT_GT(row.seconds, 0) << row.orbit;
    EXPECT_EQ(row.tolerance == 0, row.method == "closed form" || row.method == "quadrature");
  }
  EXPECT_EQ(rows.size(), 13u);
  EXPECT_EQ(rows["circular at 6 M, 100 turns"], 5);
  EXPECT_EQ(rows["static at 6 M"], 1);
  EXPECT_EQ(rows["bound from 10 to 20 M, 100 turns"], 5);
}

}  // namespace
}  // namespace domefall
