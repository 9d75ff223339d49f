#include "pipeline/light/wormhole_zones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace domefall {
namespace {

using std::numbers::pi;
using Profile = Wormhole::Profile;

std::vector<Wormhole> some_wormholes() {
  return {{1, Profile::kEllis},
          {1, Profile::kDngr, 0, 0.05},
          {1, Profile::kDngr, 0.01, 0.05},
          {1, Profile::kDngr, 10, 0.0143},
          {1, Profile::kDngr, 1, 2.86}};
}

constexpr double kPlaces[] = {-1e5, -6.2, -0.4, 0, 1e-9, 0.3, 0.6, 5.001, 30};

TEST(WormholeZones, FillTheViewOnceWithBothSkies) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces) {
      const auto [own, other] = wormhole_zones(w, l);
      EXPECT_EQ(own.sky, l < 0 ? SkyRegion::kIII : SkyRegion::kI);
      EXPECT_EQ(other.sky, l < 0 ? SkyRegion::kI : SkyRegion::kIII);
      EXPECT_EQ(own.sign, 1);
      EXPECT_EQ(other.sign, -1);
      const double edge = 2 * std::atan2(own.edge.sine, own.edge.cosine);
      EXPECT_NEAR(std::sin(edge) * w.radius(l), 1, 1e-14);
      EXPECT_LE(edge, pi / 2);
      EXPECT_NEAR(other.reach, edge, 1e-16);
      EXPECT_NEAR(own.reach + other.reach, pi, 1e-15);
    }
}

TEST(WormholeZones, InTheThroatEachSkyIsHalfTheView) {
  for (const Wormhole& w : some_wormholes()) {
    const auto [own, other] = wormhole_zones(w, 0);
    EXPECT_NEAR(own.edge.sine, own.edge.cosine, 2e-16);
    for (const double distance : {1e-9, 0.01, 0.7, 1.5}) {
      const double seen = own.azimuth(distance);
      EXPECT_NEAR(other.azimuth(distance) / seen, 1, 1e-14);
    }
  }
}

TEST(WormholeZones, TheAzimuthFallsFromTheEdgeToNothing) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const WormholeZone& zone : wormhole_zones(w, l)) {
        double before = HUGE_VAL;
        for (double part = 1e-9; part < 1; part *= 1.25) {
          const double phi = zone.azimuth(part * zone.reach);
          EXPECT_LT(phi, before) << l << " " << part;
          before = phi;
        }
        EXPECT_NEAR(zone.azimuth(zone.reach), 0, 1e-13 * (1 + w.length));
      }
}

TEST(WormholeZones, HaveTheirPartsAndTheLawOfTheirEdge) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const WormholeZone& zone : wormhole_zones(w, l)) {
        const double x = std::min(zone.reach, pi - zone.reach) * 1e-7;
        EXPECT_NEAR((zone.bent_azimuth(x) + zone.straight_azimuth(x)) / zone.azimuth(x), 1, 1e-13);
        // Next to the throat the law holds within that distance only, and goes over into that of the
        // throat, where the edge is twofold.
        const double grown = zone.bent_azimuth(x / 16) - zone.bent_azimuth(x);
        if (w.beyond_mouth(l) == 0 || w.beyond_mouth(l) > 1e-3) {
          EXPECT_NEAR(grown / (zone.logarithm * std::log(16)), 1, 1e-3) << l;
        }
      }
}

// There the law of the edge holds, so that a table may begin at a small part of it.
TEST(WormholeZones, HaveNoStructureBelowTheirLeastAngle) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const WormholeZone& zone : wormhole_zones(w, l))
        for (const double part : {1e-7, 1e-6, 1e-5}) {
          const double x = part * zone.least;
          const double law = zone.bent_azimuth(x / 2) - zone.bent_azimuth(x);
          EXPECT_NEAR(law / (zone.logarithm * std::log(2)), 1, 40 * part) << l << " " << w.length;
        }
}

TEST(WormholeZones, TellTheDistanceOfAnAzimuth) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const WormholeZone& zone : wormhole_zones(w, l))
        for (const double phi : {1e-3, 0.5, pi, 7.0, 20.0}) {
          const double distance = zone.distance_of(phi);
          EXPECT_GT(distance, 0);
          EXPECT_LT(distance, zone.reach);
          EXPECT_NEAR(zone.azimuth(distance), phi, 1e-11 * (1 + phi)) << l << " " << zone.sign;
        }
}

// Each half turn more shrinks a ring's distance from the edge by exp(pi/logarithm), next to it.
TEST(WormholeZones, RingsFollowEachOtherByTheLawOfTheEdge) {
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 0, 0.8}})
    for (const double l : {-40.0, 5.0})
      for (const WormholeZone& zone : wormhole_zones(w, l)) {
        const double ratio = zone.einstein_ring(3) / zone.einstein_ring(4);
        EXPECT_NEAR(ratio / std::exp(pi / zone.logarithm), 1, 0.03) << l << " " << zone.sign;
      }
}

}  // namespace
}  // namespace domefall
