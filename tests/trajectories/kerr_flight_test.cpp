// Flights with engines about a hole that spins.
#include "trajectories/kerr_flight.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "trajectories/kerr_orbit.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Keys along a free fall make nearly the same flight, with its velocities and times.
TEST(KerrFlight, ThroughTheStatesOfAFallIsThatFall) {
  const KerrHole hole{0.9L, 0};
  const KerrOrbit orbit(hole, 5, pi / 2, kerr_bound(hole, 5, 9, 0.6).value());
  std::vector<PathKey> keys;
  for (int k = 0; k <= 200; ++k) {
    const OrbitPoint p = orbit.at(k);
    keys.push_back({double(k), p.r, p.azimuth, {}, {}, p.theta});
    set_kerr_rates(hole, keys.back(), p.celerity);
  }
  const KerrFlight flight(hole, keys);
  for (const double tau : {0.0, 1.5, 33.3, 101.7, 199.9}) {
    const OrbitPoint a = flight.at(tau), b = orbit.at(tau);
    EXPECT_NEAR(a.r, b.r, 1e-6);
    EXPECT_LT((a.celerity - b.celerity).length(), 2e-6);
    EXPECT_NEAR(double(a.null_time), double(b.null_time - orbit.at(0).null_time), 1e-6);
  }
  EXPECT_EQ(flight.at(33).celerity.length() > 0, true);
  // At a key it is the state itself.
  EXPECT_LT((flight.at(33).celerity - orbit.at(33).celerity).length(), 1e-12);
  const auto there = flight.time_at(7, Leg::kOutward, 0);
  ASSERT_TRUE(there);
  EXPECT_NEAR(flight.at(*there).r, 7, 1e-12);
}

TEST(KerrFlight, WithinTheErgosphereMovesWithTheHole) {
  const KerrHole hole{0.9L, 0};
  const auto flown = [&](double azimuth, double r) {
    try {
      const KerrFlight flight(hole, {{0, 4, 0}, {20, r, azimuth}, {40, r, 2 * azimuth}});
      const OrbitPoint p = flight.at(30);
      return kerr_motion(hole, p.r, p.theta, p.celerity).energy > 0 ? std::string("flown")
                                                                    : std::string("negative");
    } catch (const std::domain_error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(flown(0, 1.7), testing::HasSubstr("within the ergosphere, where nothing rests"));
  EXPECT_THAT(flown(-20, 1.7), testing::HasSubstr("azimuth_deg must grow faster, with the hole"));
  EXPECT_EQ(flown(20, 1.7), "flown");
  EXPECT_EQ(flown(0, 2.1), "flown");
  EXPECT_THAT(flown(60, 1.2), testing::HasSubstr("nothing stops falling inside the hole"));
  EXPECT_THAT(flown(20, 0.5), testing::HasSubstr("inner horizon"));
}

}  // namespace
}  // namespace domefall
