// Three ways to follow a ray about a spin, over random observers and rays: the exact one, the
// equations over Mino's time, stepped by Fehlberg's eighth-order pair, and the chart that frames are made
// from.  A hundred thousand rays: RC_PARAMS="max_success=500 seed=..." test_report
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

#include "pipeline/light/kerr_chart.h"
#include "pipeline/report/stepped_light.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// The same rays in every run, unless the environment asks for others.
const int kSeeded = setenv("RC_PARAMS", "seed=20201125 noshrink=1", 0);

double part_of(int k) { return (k + 0.5) / 0x1p24; }
rc::Gen<double> part() { return rc::gen::map(rc::gen::inRange(0, 1 << 24), part_of); }

// Spins dense towards 1, every other hole with a charge, and observers anywhere above the inner horizon.
KerrPlace place_of(double fast, double charged, double height, double side) {
  const double spin = 1 - std::pow(10, -4 * fast), most = std::sqrt(1 - spin * spin);
  const KerrHole hole{spin, charged < 0.5 ? 0 : most * 0.9 * (2 * charged - 1)};
  const auto out = static_cast<double>(hole.horizon());
  const auto in = static_cast<double>(hole.inner_horizon());
  const double r = height < 0.25 ? in + (out - in) * (0.1 + 3.2 * height)
                                 : out * (1 + std::pow(10, -2 + 8 * (height - 0.25)));
  return {hole, r, std::acos(1 - 2 * side)};
}

struct Comparison {
  int rays = 0;
  double worst = 0;  // of its bound
};

// Rays all over the sky of I or, between the horizons, of III, half of them next to its edge.
template <class Way>
void compare(const KerrPlace& at, int count, double phase, Comparison& sum, const Way& way) {
  for (int k = 0; k < count; ++k) {
    const double golden = std::fmod(phase + k * 0.6180339887498949, 1);
    const bool third = at.delta() < 0 && k % 3 == 0;
    const KerrEdge edge = third ? KerrEdge::kRegionThree : KerrEdge::kSilhouette;
    const double eta = 2 * pi * std::fmod(phase + k * 0.7548776662466927, 1);
    const auto from = static_cast<double>(critical_ray(at, eta, edge).delta);
    const double along = k % 2 == 0 ? golden : std::pow(10, -5 * golden);
    const double offset = along * ((third ? 0 : pi) - from);
    const KerrDirection direction{from + offset, eta, edge, offset};
    const TracedKerr exact = trace_kerr(at, direction);
    const double share = way(direction, exact, third);
    RC_ASSERT(std::isfinite(share));
    sum.worst = std::max(sum.worst, share);
    ++sum.rays;
  }
}

TEST(SpinAgreement, OfExactRaysAndMinoTime) {
  constexpr int kRaysEach = tries(200, 20);
  Comparison sum;
  const bool agree = rc::check("exact rays are those of steps over Mino's time", [&] {
    const KerrPlace at = place_of(*part(), *part(), *part(), *part());
    compare(at, kRaysEach, *part(), sum, [&](const auto& direction, const auto& exact, bool third) {
      const FollowedRay steps =
          step_ray_over_mino_time({at, direction}, FallMethod::kFehlberg78, 1e-13);
      RC_ASSERT(steps.origin == (third ? SkyRegion::kIII : SkyRegion::kI));
      const double moves = exact.by_delta.length() + exact.across.length();
      const double share = (steps.place - exact.sky).length() / (1e-9 * (1 + moves));
      RC_ASSERT(share < 1);
      return share;
    });
  });
  EXPECT_TRUE(agree);
  std::cout << sum.rays << " rays, worst " << sum.worst << " of the bound\n";
}

// Few observers, since each has charts of its own.
TEST(SpinAgreement, OfChartsAndExactRays) {
  Comparison sum;
  for (const double fast : {0.1, 0.3, 0.6})
    for (const double height : {0.15, 0.27, 0.5}) {
      const KerrPlace at = place_of(fast, height + 0.3, height, 0.3 + height / 3);
      const KerrChart own(at, KerrEdge::kSilhouette);
      compare(at, tries(3000, 60), fast, sum,
              [&](const auto& direction, const auto& exact, bool third) {
                if (third) return 0.0;
                const auto delta = static_cast<double>(direction.delta);
                const auto eta = static_cast<double>(direction.eta);
                const V3d sky = own.place(delta, eta, own.edge(eta)).sky;
                const double moves = exact.by_delta.length() + exact.across.length();
                const double share = (sky - exact.sky).length() / (2e-5 + 1e-8 * moves);
                EXPECT_LT(share, 1) << at.hole.spin << " " << at.r << " " << delta << " " << eta;
                return share;
              });
    }
  std::cout << sum.rays << " rays, worst " << sum.worst << " of the bound\n";
}

}  // namespace
}  // namespace domefall
