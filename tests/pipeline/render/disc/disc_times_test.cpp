// Where and when pixels see the gas, by the tables of PlaneRays, against rays that are followed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "pipeline/light/plane_rays.h"
#include "tests/pipeline/render/disc/disc_views.h"
#include "tests/pipeline/render/disc/reference_disc.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct Scene {
  double charge, r;
};

// With t = v - r* at both ends, t at the gas is that of pixels (time_at).
TEST(PlaneRays, TellWhereAndWhenLightSetsOut) {
  std::mt19937 random(8);
  int compared = 0, of_rings = 0;
  for (const auto& [charge, r] : {Scene{0, 60},
                                  {0, 15},
                                  {0, 1.5},
                                  {0.5, 15},
                                  {0.95, 60},
                                  {1, 7},
                                  {1, 2},
                                  {0.8, 1.2},
                                  {0.3, 1e4}}) {
    const ChargedHole hole(1, charge);
    const Spacetime space = charge > 0 ? Spacetime(hole) : Schwarzschild{};
    const V3d normal = random_direction(random);
    const double from = hole.last_stable_orbit(), to = 20;
    const PlaneRays plane({space, r, Tetrad::kRain}, 100, {normal, from, to, true});
    const ReferenceDiscView view{r,    false, {0, 0, 0}, {normal.x, normal.y, normal.z},
                                 from, to,    true,      charge};
    for (int k = 0; k < 60; ++k) {
      // Half of the rays pass near the hole.
      V3d n = random_direction(random);
      if (k % 2 == 0) n = (V3d(-1, 0, 0) + n * (12 / (r + 12))).normalized();
      DirectionBatch batch;
      batch.x[0] = n.x, batch.y[0] = n.y, batch.z[0] = n.z;
      const double width = 1e-6;
      PlaneCrossings crossing;
      plane.locate(batch, &width, 1, crossing);
      for (const ReferenceDiscPlace& place : reference_disc(view, {n.x, n.y, n.z}, 3)) {
        const double turn = crossing.turn[0] + place.order * pi;
        const PlaneImages::Interval rims = plane.images().interval(turn);
        const double u = (crossing.label[0] - rims.low) / (rims.high - rims.low);
        // The tables may err by 2e-7 of p, of which the images of higher order are thinner.
        const double loose = 1e-4 + 4e-6 * std::exp(pi * place.order);
        ASSERT_GT(u, -loose) << charge << " " << r;
        ASSERT_LT(u, 1 + loose) << charge << " " << r;
        const PlaneImages::Moment moment = plane.images().moment(turn, std::clamp(u, 0.0, 1.0));
        EXPECT_NEAR(moment.w * place.r, 1, 20 * loose) << charge << " " << r << " " << place.order;
        const double since =
            100 - place.delay -
            (charge > 0 ? hole.tortoise(place.r) : Schwarzschild::tortoise(place.r));
        // Next to the observer and to rims times change too fast for the table's cubics.
        EXPECT_NEAR(plane.clock().time_at(place.r, moment.time), since, 0.1 + 100 * loose)
            << charge << " " << r << " " << place.order << " " << place.r;
        ++compared;
        of_rings += place.order > 0;
      }
    }
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(of_rings, 4);  // compilers throw the dice in different orders
}

}  // namespace
}  // namespace domefall
