#include "trajectories/accelerated_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/trajectories/conserved.h"
#include "tests/trajectories/motion.h"
#include "trajectories/charged_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/static_observer.h"
#include "trajectories/trajectory.h"

namespace domefall {
namespace {

using testing::HasSubstr;

// From hovering at 10 M to hovering at 2.5 M, a quarter around.
AcceleratedPath descent() { return AcceleratedPath({{0, 10, 0, 0, 0}, {60, 2.5, 1.5, 0, 0}}); }

TEST(AcceleratedPath, APoweredDescentBeginsAndEndsAtRest) {
  const AcceleratedPath path = descent();
  for (const double tau : {0.0, 60.0}) {
    const OrbitPoint p = path.at(tau);
    EXPECT_NEAR(p.celerity.x, resting_celerity(p.r).x, 1e-15);
    EXPECT_EQ(p.celerity.z, 0);
  }
  EXPECT_EQ(path.at(0).r, 10);
  EXPECT_NEAR(path.at(60).r, 2.5, 1e-15);
  EXPECT_NEAR(path.at(60).azimuth, 1.5, 1e-15);
}

TEST(AcceleratedPath, ItsStatesMoveAsItsPlacesDo) {
  const AcceleratedPath path = descent();
  const double h = 1e-4;
  for (double tau = 1; tau < 60; tau += 1.7) {
    const OrbitPoint p = path.at(tau), before = path.at(tau - h), after = path.at(tau + h);
    EXPECT_NEAR(radial_speed_of(p), (after.r - before.r) / (2 * h), 1e-8);
    EXPECT_NEAR(p.celerity.z, p.r * (after.azimuth - before.azimuth) / (2 * h), 1e-8);
    const double l = p.celerity.z, e = energy_of(p);
    EXPECT_NEAR(double(after.null_time - before.null_time) / (2 * h),
                (1 + l * l) / (e - radial_speed_of(p)), 1e-8);
  }
}

// Rounding of r - 2 is all that is left of dv/dtau there; it once took all memory to resolve that.
TEST(AcceleratedPath, AClimbFromNextToTheHorizonIsTabulated) {
  for (const double off : {1e-3, 1e-4, 1e-6, 1e-9}) {
    const AcceleratedPath path({{0, 10, 0, 0, 0}, {60, 2 + off, 0, 0, 0}, {120, 10, 0, 0, 0}});
    const OrbitPoint down = path.at(60), up = path.at(120);
    // v = t + r* goes by the same r* both ways, and by t twice.
    const double rstar = 10 + 2 * std::log(4.0) - down.r - 2 * std::log((down.r - 2) / 2);
    EXPECT_NEAR(double(up.null_time - down.null_time), double(down.null_time) + 2 * rstar,
                1e-10 + 1e-12 / off);
  }
}

// Its lowest place lies between the samples at which it is examined.
TEST(AcceleratedPath, APathThatTouchesTheHorizonIsRefused) {
  const double f = std::sqrt(1.0 / 3), in = 0.766983, out = 0.74397351;
  const auto rate = [f](double v) { return v / std::sqrt(1 - v * v) * f; };
  try {
    const AcceleratedPath path({{0, 3, 0, -rate(in), 0}, {6, 3, 0, rate(out), 0}});
    FAIL() << path.at(2.9468298206751853).r;
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("nothing stops falling inside the hole"));
  }
}

TEST(AcceleratedPath, APathOverTheHorizonIsSmoothThere) {
  const AcceleratedPath path({{0, 6, 0}, {4, 3, 0.3}, {5.2, 1, 0.35}});
  const double horizon = double(path.time_at(2, Leg::kInward).value());
  EXPECT_EQ(path.at(horizon - 1e-3).region, Region::kI);
  EXPECT_EQ(path.at(horizon + 1e-3).region, Region::kII);
  for (const double h : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const OrbitPoint a = path.at(horizon - h), b = path.at(horizon + h);
    EXPECT_NEAR((b.r - a.r) / (2 * h), radial_speed_of(a), 10 * h + 1e-14 / h);
    EXPECT_NEAR(b.celerity.x, a.celerity.x, 20 * h + 1e-13);
    EXPECT_NEAR(double(b.null_time), double(a.null_time), 20 * h + 1e-13);
  }
}

// Sampled finely, a geodesic's keys make its path.
TEST(AcceleratedPath, FollowsAGeodesicThroughItsKeys) {
  const Geodesic fall = fall_from_rest(8, 2);
  std::vector<PathKey> keys;
  const double end = 0.98 * fall.death();
  for (int k = 0; k <= 400; ++k) {
    const double tau = end * k / 400;
    const OrbitPoint p = fall.at(tau);
    keys.push_back({tau, p.r, p.azimuth, radial_speed_of(p), p.celerity.z / p.r});
  }
  const AcceleratedPath path(keys);
  for (double tau = 0.05; tau < end; tau += 0.37) {
    const OrbitPoint p = path.at(tau), q = fall.at(tau);
    EXPECT_NEAR(p.r, q.r, 1e-6);
    EXPECT_NEAR(double(p.null_time), double(q.null_time), 1e-4);
    EXPECT_NEAR(energy_of(p), fall.energy(), 1e-3) << tau;
  }
}

TEST(AcceleratedPath, RisesOutOfRegionFourInTheOutgoingTetrad) {
  const AcceleratedPath path({{0, 0.5, 0}, {0.6, 1.8, 0}, {3, 4, 0.1}, {8, 5, 0.2, 0.0}},
                             Tetrad::kOutgoing);
  EXPECT_EQ(path.at(0.1).region, Region::kIV);
  EXPECT_EQ(path.at(7).region, Region::kI);
  EXPECT_NEAR(path.at(8).celerity.x, resting_celerity(5, Tetrad::kOutgoing).x, 0.01);
  const AcceleratedPath mirror({{0, 0.5, 0}, {0.6, 1.8, 0}, {3, 4, 0.1}, {8, 5, 0.2, 0.0}},
                               Tetrad::kOutgoingToThree);
  EXPECT_EQ(mirror.at(7).region, Region::kIII);
  EXPECT_EQ(mirror.at(7).celerity, path.at(7).celerity);
  for (double tau = 0; tau <= 8; tau += 0.1)
    EXPECT_TRUE(has_tetrad(mirror.at(tau).region, mirror.at(tau).tetrad));
}

TEST(AcceleratedPath, DoesNotOvershootItsKeys) {
  const AcceleratedPath path({{0, 10, 0}, {1, 10, 0}, {2, 3, 1}, {3, 3, 1}, {20, 9, 1.1}});
  for (double tau = 0; tau <= 20; tau += 0.01) {
    EXPECT_LE(path.at(tau).r, 10);
    EXPECT_GE(path.at(tau).r, 3);
  }
  EXPECT_EQ(path.at(2.5).r, 3);
}

TEST(AcceleratedPath, TimeAtFindsEveryPassage) {
  const AcceleratedPath path({{0, 10, 0}, {10, 4, 0}, {20, 8, 0}, {30, 5, 0}});
  const double down = double(path.time_at(6, Leg::kInward).value());
  const double up = double(path.time_at(6, Leg::kOutward).value());
  const double again = double(path.time_at(6, Leg::kInward, down + 1).value());
  EXPECT_LT(down, up);
  EXPECT_LT(up, again);
  for (const double tau : {down, up, again}) EXPECT_NEAR(path.at(tau).r, 6, 1e-14);
  EXPECT_FALSE(path.time_at(3.9, Leg::kInward));
  EXPECT_FALSE(path.time_at(6, Leg::kOutward, 21));
  EXPECT_EQ(path.time_at(4, Leg::kInward).value(), 10);
}

TEST(AcceleratedPath, EndsWhereItsKeysEnd) {
  EXPECT_THROW(descent().at(61), std::domain_error);
  EXPECT_THROW(descent().at(std::nan("")), std::domain_error);
  EXPECT_EQ(descent().begin(), 0);
  EXPECT_EQ(descent().end(), 60);
  EXPECT_EQ(point_at(Trajectory(descent()), 60).r, descent().at(60).r);
}

// Its states say how its places change, outside a charge, between its horizons and inside of both,
// and about a naked singularity.
TEST(AcceleratedPath, NearAChargeItsStatesMoveAsItsPlacesDo) {
  const ChargedHole hole(1, 0.8L), naked(1, 1.2L);
  const AcceleratedPath in(
      {{0, 6, 0}, {4, 3, 0.3}, {5.2, 1, 0.35}, {5.7, 0.36, 0.36, 0.0}, {9, 0.34, 1}}, Tetrad::kRain,
      hole);
  const AcceleratedPath about({{0, 6, 0}, {20, 0.1, 0.3, 0}, {40, 3, 0.35}}, Tetrad::kRain, naked);
  const AcceleratedPath out({{0, 0.35, 0}, {0.4, 0.8, 0}, {3, 4, 0.1}, {8, 5, 0.2, 0.0}},
                            Tetrad::kOutgoing, hole);
  EXPECT_EQ(in.at(1).region, Region::kI);
  EXPECT_EQ(in.at(5).region, Region::kII);
  EXPECT_EQ(in.at(8).region, Region::kV);
  EXPECT_EQ(about.at(20).region, Region::kI);
  EXPECT_EQ(out.at(0).region, Region::kV);
  EXPECT_EQ(out.at(0.4).region, Region::kIV);
  EXPECT_EQ(out.at(8).region, Region::kI);
  const auto check = [](const AcceleratedPath& path, const ChargedHole& space) {
    const double h = 1e-5;
    for (double tau = 0.013; tau < path.end(); tau += 0.37) {
      const OrbitPoint p = path.at(tau), before = path.at(tau - h), after = path.at(tau + h);
      const Conserved m = conserved_by(space, p);
      EXPECT_NEAR(m.radial, (after.r - before.r) / (2 * h), 1e-7 * (1 + m.scale)) << p.r;
      EXPECT_NEAR(p.celerity.z, p.r * (after.azimuth - before.azimuth) / (2 * h), 1e-7) << p.r;
      const double inward = is_outgoing(p.tetrad) ? m.radial : -m.radial,
                   f = space.lapse_squared(p.r);
      // dv/dtau, of which E + inward vanishes nowhere but on the horizon that is not crossed.
      const double rate = (1 + p.celerity.z * p.celerity.z) / (m.energy + inward);
      EXPECT_NEAR(double(after.null_time - before.null_time) / (2 * h), rate,
                  1e-6 * rate * (1 + 1 / std::abs(f)))
          << p.r;
      EXPECT_GE(m.energy, 0);
    }
  };
  check(in, hole);
  check(about, naked);
  check(out, hole);
}

TEST(AcceleratedPath, FollowsAFallIntoAChargeThroughItsKeys) {
  const ChargedHole hole(1, 0.9L);
  const ChargedOrbit fall = ChargedOrbit::from_rest(hole, 8, 1.5);
  const double end = double(*fall.time_at(1, Leg::kInward));
  std::vector<PathKey> keys;
  for (int k = 0; k <= 400; ++k) {
    const OrbitPoint p = fall.at(end * k / 400);
    keys.push_back(
        {end * k / 400, p.r, p.azimuth, conserved_by(hole, p).radial, p.celerity.z / p.r});
  }
  const AcceleratedPath path(keys, Tetrad::kRain, hole);
  for (double tau = 0.05; tau < end; tau += 0.37) {
    const OrbitPoint p = path.at(tau), q = fall.at(tau);
    EXPECT_NEAR(p.r, q.r, 1e-6);
    EXPECT_NEAR(double(p.null_time), double(q.null_time), 1e-4);
    EXPECT_NEAR(conserved_by(hole, p).energy, fall.energy(), 1e-3) << tau;
  }
}

TEST(AcceleratedPath, RefusesWhatCannotBeFlown) {
  const auto refusal = [](const std::vector<PathKey>& keys, Tetrad tetrad = Tetrad::kRain) {
    try {
      const AcceleratedPath path(keys, tetrad);
    } catch (const std::domain_error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({{0, 10, 0}}), HasSubstr("at least 2 keys"));
  EXPECT_THAT(refusal({{0, 10, 0}, {0, 9, 0}}), HasSubstr("key 2, at proper time 0"));
  EXPECT_THAT(refusal({{0, 10, 0}, {1e-300, 9, 0}}), HasSubstr("too close in proper time"));
  EXPECT_THAT(refusal({{0, 10, 0}, {1, -1, 0}}), HasSubstr("r must exceed 0 (units of M), got -1"));
  EXPECT_THAT(refusal({{0, 10, 0}, {1, std::nan(""), 0}}), HasSubstr("finite numbers"));
  EXPECT_THAT(refusal({{0, 1.5, 0}, {0.6, 1.0, 0}, {0.7, 1.0, 0}}),
              HasSubstr("(units of M): after it, at r = 1"));
  EXPECT_THAT(refusal({{0, 1.5, 0, 0.1}, {0.3, 1.0, 0}}),
              HasSubstr("key 1, at proper time 0 (units of M): after it, at r = 1.5, nothing stops "
                        "falling inside the hole"));
  EXPECT_THAT(refusal({{0, 1.5, 0}, {100, 1.0, 0}}), HasSubstr("faster than light"));
  EXPECT_THAT(refusal({{0, 1.5, 0}, {0.3, 1.0, 9}}), HasSubstr("faster than light"));
  EXPECT_THAT(refusal({{0, 1.5, 0}, {0.3, 1.0, 0}}, Tetrad::kOutgoing),
              HasSubstr("nothing stops rising in region IV"));
  EXPECT_THAT(refusal({{0, 5, 0, -50.0}, {10, 5, 0}}), HasSubstr("singularity"));
  EXPECT_THAT(refusal({{0, 5, 0, std::nan("")}, {10, 5, 0}}), HasSubstr("key 1"));
  const auto near_charge = [](const std::vector<PathKey>& keys, long double charge) {
    try {
      const AcceleratedPath path(keys, Tetrad::kRain, ChargedHole(1, charge));
    } catch (const std::domain_error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(near_charge({{0, 1.5, 0}, {100, 1.0, 0}}, 0.8L), HasSubstr("faster than light"));
  EXPECT_THAT(near_charge({{0, 1.5, 0, 0.1}, {0.3, 1.0, 0}}, 0.8L), HasSubstr("nothing stops"));
  EXPECT_EQ(near_charge({{0, 1.65, 0}, {100, 1.61, 0}}, 0.8L), "accepted");
  EXPECT_EQ(near_charge({{0, 0.39, 0}, {100, 0.38, 0}}, 0.8L), "accepted");
  EXPECT_EQ(near_charge({{0, 1.5, 0}, {100, 1.0, 0}}, 1.2L), "accepted");
}

}  // namespace
}  // namespace domefall
