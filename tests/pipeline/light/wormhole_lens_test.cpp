#include "pipeline/light/wormhole_lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

HoleOptics optics_at(const Wormhole& w, double l) {
  ObserverState observer;
  observer.l = l;
  return make_wormhole_optics(w, observer);
}

// The zone of the own side's sky, and that of the other side's.
std::array<SkyZone, 2> zones_of(const Wormhole& w, double l) {
  const HoleOptics optics = optics_at(w, l);
  return {optics.parts.at(0).zone, optics.parts.at(1).zone};
}

constexpr double kPlaces[] = {-1e5, -6.2, -0.4, 0, 1e-9, 0.3, 0.6, 5.001, 30};

TEST(WormholeZones, FillTheViewOnceWithBothSkies) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces) {
      const HoleOptics optics = optics_at(w, l);
      ASSERT_EQ(optics.parts.size(), 2u);
      EXPECT_EQ(optics.parts[0].sky, l < 0 ? SkyRegion::kIII : SkyRegion::kI);
      EXPECT_EQ(optics.parts[1].sky, l < 0 ? SkyRegion::kI : SkyRegion::kIII);
      const auto [own, other] = zones_of(w, l);
      EXPECT_EQ(own.edge.sign, 1);
      EXPECT_EQ(other.edge.sign, -1);
      const double edge = own.edge.half.angle();
      EXPECT_NEAR(std::sin(edge) * w.radius(l), 1, 1e-14);
      EXPECT_LE(edge, pi / 2);
      EXPECT_NEAR(other.reach, edge, 1e-16);
      EXPECT_NEAR(own.reach + other.reach, pi, 1e-15);
    }
}

TEST(WormholeZones, InTheThroatEachSkyIsHalfTheView) {
  for (const Wormhole& w : some_wormholes()) {
    const auto [own, other] = zones_of(w, 0);
    EXPECT_NEAR(own.edge.half.sine, own.edge.half.cosine, 2e-16);
    for (const double distance : {1e-9, 0.01, 0.7, 1.5}) {
      const double seen = own.azimuth(distance);
      EXPECT_NEAR(other.azimuth(distance) / seen, 1, 1e-14);
    }
  }
}

TEST(WormholeZones, TheAzimuthFallsFromTheEdgeToNothing) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const SkyZone& zone : zones_of(w, l)) {
        double before = HUGE_VAL;
        for (double part = 1e-9; part < 1; part *= 1.25) {
          const double phi = zone.azimuth(part * zone.reach);
          EXPECT_LT(phi, before) << l << " " << part;
          before = phi;
        }
        EXPECT_NEAR(zone.azimuth(zone.reach), 0, 1e-13 * (1 + w.length));
      }
}

double without_winding(const SkyZone& zone, double offset) {
  return zone.azimuth(offset) - (zone.winding ? zone.winding(offset) : 0);
}

TEST(WormholeZones, HaveTheLawOfTheirEdge) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const SkyZone& zone : zones_of(w, l)) {
        // Rays that turn before the mouth wind about no cylinder.
        EXPECT_EQ(bool(zone.winding),
                  w.half_length() > 0 && (zone.edge.sign < 0 || w.in_cylinder(l)));
        // Next to the throat the law holds within that distance only, and goes over into that of the
        // throat, where the edge is twofold.
        if (l != 0 && w.beyond_mouth(l) <= 1e-3) continue;
        const double x = std::min(zone.reach, pi - zone.reach) * 1e-7;
        const double grown = without_winding(zone, x / 16) - without_winding(zone, x);
        EXPECT_NEAR(grown / (zone.logarithm * std::log(16)), 1, 1e-3) << l;
      }
}

// There the law of the edge holds, so that a table may begin at a small part of it.
TEST(WormholeZones, HaveNoStructureBelowTheirLeastAngle) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (const SkyZone& zone : zones_of(w, l))
        for (const double part : {1e-7, 1e-6, 1e-5}) {
          const double x = part * zone.least;
          const double law = without_winding(zone, x / 2) - without_winding(zone, x);
          const double expected = zone.logarithm * std::log(2), rounding = 4e-16 * zone.azimuth(x);
          EXPECT_NEAR(law, expected, 40 * part * expected + rounding) << l << " " << w.length;
        }
}

// Images of any order are found without an integral, 16 us each.
TEST(WormholeZones, TablesGoOnToTheEdgeByThemselves) {
  for (const Wormhole& w : some_wormholes())
    for (const double l : kPlaces)
      for (SkyZone zone : zones_of(w, l)) {
        int integrals = 0;
        const auto exact = zone.azimuth;
        zone.azimuth = [&](double offset) { return ++integrals, exact(offset); };
        const SkyTable table(zone);
        const int made = integrals;
        for (int order = 1; order < 48; ++order) {
          const double phi = order * 0.9 * pi, x = table.distance(phi);
          if (!(x > 1e-140)) break;  // the square of less is no double
          EXPECT_NEAR(table.azimuth(x) / phi, 1, 1e-11) << l << " " << w.length << " " << order;
          const double offset = 4 * std::atan(x / 2), near = 1e-4 * offset;
          EXPECT_NEAR(exact(offset) / phi, 1, 1e-8) << l << " " << w.length << " " << order;
          const double slope = (exact(offset - near) - exact(offset + near)) / (2 * near);
          EXPECT_NEAR(table.slope(x) / slope, 1, 1e-5) << l << " " << w.length << " " << order;
        }
        EXPECT_EQ(integrals, made);
      }
}

// Each half turn more shrinks a ring's distance from the edge by exp(pi/logarithm), next to it.
TEST(WormholeZones, RingsFollowEachOtherByTheLawOfTheEdge) {
  for (const Wormhole& w : {Wormhole{1, Profile::kEllis}, Wormhole{1, Profile::kDngr, 0, 0.8}})
    for (const double l : {-40.0, 5.0})
      for (const SkyZone& zone : zones_of(w, l)) {
        const SkyTable table(zone);
        const double ratio = table.distance(3 * pi) / table.distance(4 * pi);
        EXPECT_NEAR(ratio / std::exp(pi / zone.logarithm), 1, 0.03) << l << " " << zone.edge.sign;
      }
}

}  // namespace
}  // namespace domefall
