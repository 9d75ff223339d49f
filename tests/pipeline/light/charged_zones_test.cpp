#include "pipeline/light/charged_zones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/exact_azimuth.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Calls f(hole, place, outgoing) for charges of every kind and places in each of their blocks.
template <class F>
void at_charged_places(const F& f) {
  for (const double q : {0.0, 1e-3, 0.5, 0.8, 0.99, 0.999999, 1.0, 1.02, 1.05, 1.2, 2.0}) {
    const ChargedHole hole(1, q);
    for (const bool outgoing : {false, true}) {
      const auto at = [&](double r) { f(hole, hole.at(r), outgoing); };
      for (const double r : {1.01, 1.3, 1.4999, 1.9, 2.5, 3.2, 10.0, 1e4}) at(r);
      if (q == 0) continue;
      const double inner = hole.is_naked() ? 1 : hole.inner_horizon();
      for (const double part : {0.01, 0.5, 0.99, 1.01}) at(part * inner);
      if (hole.has_light_circle()) {
        const double end = hole.edges_end();
        at(end * (1 - 1e-4));
        if (!hole.is_naked()) at(end + (inner - end) * 0.3);
      }
      if (hole.is_naked()) continue;
      for (const double off : {1e-6, -1e-6}) {
        f(hole, hole.at(ChargedMark::kOuterHorizon, off), outgoing);
        f(hole, hole.at(ChargedMark::kInnerHorizon, off * inner), outgoing);
      }
    }
  }
}

std::string place_of(const ChargedZone& zone) {
  return "q " + std::to_string(zone.view.hole().charge) + " r " + std::to_string(zone.view.at().r) +
         (zone.view.outgoing() ? " T'" : " T") + " edge " +
         std::to_string(static_cast<double>(zone.edge_angle.angle)) + " sign " +
         std::to_string(zone.sign) + " reach " + std::to_string(zone.reach);
}

TEST(ChargedZones, FillTheViewOnce) {
  at_charged_places([](const ChargedHole& hole, const ChargedRadius& at, bool outgoing) {
    double end = 0;
    for (const ChargedZone& zone : charged_zones(hole, at, outgoing)) {
      const auto edge = static_cast<double>(zone.edge_angle.angle);
      const double low = zone.sign > 0 ? edge : edge - zone.reach;
      EXPECT_NEAR(low, end, 1e-15) << place_of(zone);
      EXPECT_GT(zone.reach, 0) << place_of(zone);
      end = zone.sign > 0 ? edge + zone.reach : edge;
    }
    EXPECT_NEAR(end, pi, 1e-15);
  });
}

TEST(ChargedZones, HaveOneSkyEachWhoseAzimuthFallsWithoutAStep) {
  at_charged_places([](const ChargedHole& hole, const ChargedRadius& at, bool outgoing) {
    for (const ChargedZone& zone : charged_zones(hole, at, outgoing)) {
      constexpr int kSteps = 60;
      double before = 0, step_before = 0;
      for (int k = 1; k < kSteps; ++k) {
        // These are offsets from a millionth of the reach to the whole of it.
        const double offset = zone.reach * std::pow(10, 6.0 * (k - kSteps + 0.5) / kSteps);
        ASSERT_EQ(zone.view.origin_of(zone.ray(offset)), zone.sky)
            << place_of(zone) << " at " << offset;
        if (zone.sky == ChargedOrigin::kDark) continue;
        const double phi = zone.azimuth(offset);
        ASSERT_TRUE(std::isfinite(phi)) << place_of(zone) << " at " << offset;
        const double step = phi - before;
        if (k > 1) {
          const bool rises = zone.start == ZoneStart::kRoot || zone.start == ZoneStart::kLine;
          ASSERT_TRUE(rises ? step > -1e-14 : step < 1e-14)
              << place_of(zone) << " at " << offset << " " << step;
        }
        if (k > 2) {
          ASSERT_LT(std::abs(step), 2 * std::abs(step_before) + 0.02)
              << place_of(zone) << " at " << offset;
        }
        before = phi;
        step_before = step;
      }
    }
  });
}

TEST(ChargedZones, GoOnBeyondTheirReach) {
  at_charged_places([](const ChargedHole& hole, const ChargedRadius& at, bool outgoing) {
    for (const ChargedZone& zone : charged_zones(hole, at, outgoing)) {
      if (zone.sky == ChargedOrigin::kDark) continue;
      const double h = 1e-3 * zone.reach;
      const auto phi = [&](int k) { return zone.azimuth(zone.reach + k * h); };
      EXPECT_LT(std::abs(phi(2) - 3 * phi(1) + 3 * phi(0) - phi(-1)),
                1e-3 * std::abs(phi(1) - phi(0)) + 1e-13)
          << place_of(zone);
      if (zone.ends_on_axis) {
        EXPECT_NEAR(phi(0), 0, 1e-14) << place_of(zone);
      }
    }
  });
}

// The laws of the zones' edges, far below their smallest angles.
TEST(ChargedZones, BeginAsTheySay) {
  at_charged_places([](const ChargedHole& hole, const ChargedRadius& at, bool outgoing) {
    for (const ChargedZone& zone : charged_zones(hole, at, outgoing)) {
      if (zone.sky == ChargedOrigin::kDark) continue;
      const double small = 1e-7 * zone.smallest_angle, x = 2 * std::tan(small / 4);
      const double phi = zone.azimuth(small), next = zone.azimuth(small / 4);
      switch (zone.start) {
        case ZoneStart::kLogarithm:
          EXPECT_NEAR(next - phi, zone.coefficient * std::log(4), 2e-5) << place_of(zone);
          break;
        case ZoneStart::kRoot:
          EXPECT_NEAR(phi / (zone.coefficient * std::sqrt(x)), 1, 2e-3) << place_of(zone);
          break;
        case ZoneStart::kLine:
          EXPECT_NEAR(phi / (zone.coefficient * x), 1, 1e-10) << place_of(zone);
          break;
        default:
          EXPECT_NEAR(next, phi, 1e-12) << place_of(zone);
      }
    }
  });
}

// Without a charge, and with next to none, light is Schwarzschild's.  Rain moves inward against T, so
// that it sees tan(delta/2) smaller by 1 + s.
TEST(ChargedView, WithoutChargeIsSchwarzschilds) {
  int rays = 0;
  for (const double q : {0.0, 1e-9})
    for (const double r : {1e-3, 0.3, 1.7, 1.999, 2.001, 2.7, 3.4, 20.0, 1e5}) {
      const ChargedHole hole(1, q);
      for (const bool outgoing : {false, true})
        for (const ChargedZone& zone : charged_zones(hole, hole.at(r), outgoing)) {
          if (zone.start != ZoneStart::kLogarithm || zone.sky == ChargedOrigin::kBefore ||
              zone.sky == ChargedOrigin::kParallelBefore)
            continue;
          const long double tangent = zone.view.tan_half_critical(zone.critical);
          for (const double part : {1e-9, 1e-5, 1e-2, 0.3, 0.9, 0.999}) {
            const double offset = part * zone.reach;
            const ChargedRay ray = zone.ray(offset);
            // The excess of the ratio over 1, without cancelling.
            const long double gap =
                zone.critical == Critical::kFirst ? ray.gap_first : ray.gap_second;
            const auto excess = static_cast<double>(gap / ray.cos_half / tangent);
            ++rays;
            const NullRay same = ray_of_ratio(r, zone.critical, excess, outgoing);
            const double phi = exact_azimuth(same);
            EXPECT_NEAR(zone.azimuth(offset), phi, 1e-12 * std::max(1.0, phi)) << place_of(zone);
          }
        }
    }
  EXPECT_GT(rays, 200);
}

}  // namespace
}  // namespace domefall
