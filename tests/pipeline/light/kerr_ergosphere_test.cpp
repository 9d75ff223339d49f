// The ergosphere's outline, by rays that are followed by Hamilton's equations.
#include "pipeline/light/kerr_ergosphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/light/kerr_view.h"
#include "tests/pipeline/light/kerr_schild.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

using std::numbers::pi;

// Returns how near light has come to the surface Delta = a^2 sin^2(theta), negative inside, in steps of
// which none is longer than 0.02 M.
double nearest(const KerrPlace& at, double delta, double eta) {
  const auto a = static_cast<double>(at.hole.spin), q = static_cast<double>(at.hole.charge),
             r = static_cast<double>(at.r);
  auto [hole, state] = kerr_schild_start(a, q, r, static_cast<double>(at.theta), delta, eta);
  boost::numeric::odeint::runge_kutta4<KerrSchildState> stepper;
  double least = HUGE_VAL, time = 0;
  while (time < 200 + 4 * r) {
    const double there = hole.radius(state), u = state[2] / there;
    const double outside = there * there - 2 * there + q * q + a * a * u * u;
    least = std::min(least, outside);
    if (outside < 0 || there > 3 + 2 * r) break;
    const double step = std::max(0.005, 0.01 * (there - 1));
    stepper.do_step(hole, state, time, step);
    time += step;
  }
  return least;
}

TEST(Ergosphere, HasTheOutlineOfTheRaysThatEnterIt) {
  int beyond_edge = 0;
  for (const KerrPlace& at : {KerrPlace{{0.95L, 0}, 8, pi / 2}, KerrPlace{{0.998L, 0}, 15, 1.0L},
                              KerrPlace{{0.9L, 0}, 2.4L, 1.4L}, KerrPlace{{0.8L, 0.5L}, 6, 1.2L},
                              KerrPlace{{0.9L, 0}, 1.6L, 0.1L}}) {
    ASSERT_FALSE(in_ergosphere(at));
    const std::vector<V3d> outline = ergosphere_outline(at);
    for (std::size_t k = 0; k < outline.size(); k += kSanitized ? 128 : 16) {
      const KerrDirection direction = kerr_direction_of(outline[k]);
      const auto delta = static_cast<double>(direction.delta),
                 eta = static_cast<double>(direction.eta),
                 edge = static_cast<double>(critical_ray(at, eta, KerrEdge::kSilhouette).delta);
      ASSERT_GE(delta, edge - 1e-12);
      const double step = 0.004 * (pi - edge);
      EXPECT_GT(nearest(at, delta + step, eta), 0) << eta;
      // Light from within the silhouette's edge has been in it, too.
      EXPECT_LT(nearest(at, delta - step, eta), 1e-4) << eta << " " << delta - edge;
      beyond_edge += delta > edge + 0.01;
    }
  }
  EXPECT_GT(beyond_edge, kSanitized ? 3 : 40);
}

// Light circles nowhere within r = 2 while a < 1/sqrt(2), so that all light that enters the ergosphere
// comes from the hole.
TEST(Ergosphere, OfASlowHoleIsSeenAsItsSilhouette) {
  for (const double theta : {0.3, 1.0, pi / 2}) {
    const KerrPlace at{{0.7L, 0}, 10, theta};
    for (const V3d& n : ergosphere_outline(at)) {
      const KerrDirection direction = kerr_direction_of(n);
      const CriticalRay edge = critical_ray(at, direction.eta, KerrEdge::kSilhouette);
      ASSERT_NEAR(static_cast<double>(direction.delta), static_cast<double>(edge.delta), 1e-5);
    }
  }
}

TEST(Ergosphere, ReachesFromTheHorizonOnTheAxisToTwoInTheEquator) {
  const KerrHole hole{0.9L, 0};
  EXPECT_FALSE(in_ergosphere({hole, 2.001L, pi / 2}));
  EXPECT_TRUE(in_ergosphere({hole, 1.999L, pi / 2}));
  EXPECT_FALSE(in_ergosphere({hole, hole.horizon() + 0.001L, 0}));
  EXPECT_TRUE(in_ergosphere({hole, hole.horizon() - 0.001L, 0}));
}

}  // namespace
}  // namespace domefall
