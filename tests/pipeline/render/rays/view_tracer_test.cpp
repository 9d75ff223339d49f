#include "pipeline/render/rays/view_tracer.h"

#include <gtest/gtest.h>

#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// Observers of every kind in all four regions, from no aberration to a Lorentz factor of 1000.
std::vector<Show> tracing_observers() {
  const Projection dome = Domemaster{64};
  return {show_of(StaticObserver{3}, dome),
          show_of(StaticObserver{1e7}, dome),
          show_of(StaticObserver{}, dome),
          show_of(CircularOrbit{6}, dome),
          show_of(RadialInfall{2}, dome),
          show_of(RadialInfall{1.2}, dome),
          show_of(RadialInfall{0.05}, dome),
          show_of(GivenVelocity{Region::kI, Tetrad::kRain, 30, {300, -800, 500}}, dome),
          show_of(GivenVelocity{Region::kI, Tetrad::kOutgoing, 5, {1, 2, 3}}, dome),
          show_of(GivenVelocity{Region::kI, Tetrad::kOutgoing, 2.01, {0, 0, 0}}, dome),
          show_of(GivenVelocity{Region::kII, Tetrad::kRainOfThree, 1.3, {0, 1, 0}}, dome),
          show_of(GivenVelocity{Region::kIII, Tetrad::kRainOfThree, 4, {2, 0, 0}}, dome),
          show_of(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 0.2, {0, 0, 0}}, dome),
          show_of(GivenVelocity{Region::kIV, Tetrad::kOutgoing, 1.99,
                                resting_celerity(1.99, Tetrad::kOutgoing)},
                  dome),
          show_in_wormhole(4, dome),
          show_in_wormhole(0.1, dome),
          show_in_wormhole(-2, dome),
          show_of(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}}, dome)};
}

TEST(ViewTracer, TheBatchTracesAsTheSingleRayIsTraced) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (const Show& show : tracing_observers()) {
    const FrameState state = frame_state(show, 0);
    const ViewTracer tracer(state, WantedSkies{{true, true, true}, true});
    ViewRayBatch batch;
    std::array<CameraDirection, ViewRayBatch::kSize> n;
    for (int round = 0; round < 50; ++round) {
      for (auto& direction : n)
        direction.v = V3d(normal(random), normal(random), normal(random)).normalized();
      n[0].v = apply_transposed(state.observer.tetrad_from_camera, V3d(-1, 0, 0));
      n[1].v = -n[0].v;
      tracer.trace(n.data(), ViewRayBatch::kSize, batch);
      for (int k = 0; k < ViewRayBatch::kSize; ++k) {
        const ViewRay ray = tracer.trace(n[static_cast<std::size_t>(k)]);
        ASSERT_EQ(batch.sky[k], ray.sky);
        ASSERT_TRUE(ray.known);
        // Near the axis of a lens sin(phi)/sin(delta) amplifies the last bits of both.
        const double scale = 1 + ray.scale_along + ray.scale_across;
        ASSERT_LT((batch.sky_direction(k) - ray.sky_direction).length(), 2e-15 * scale);
        if (ray.sky == SkyRegion::kIV) {
          ASSERT_NEAR(batch.emission_time[k], ray.emission_time,
                      1e-9 * (1 + std::abs(ray.emission_time)));
          ASSERT_NEAR(batch.time_scale[k], ray.time_scale, 1e-9 + 1e-6 * ray.time_scale);
        }
        ASSERT_NEAR(batch.frequency_ratio[k] / ray.frequency_ratio, 1, 1e-13);
        ASSERT_NEAR(batch.scale_along[k] / ray.scale_along, 1, 1e-11);
        ASSERT_NEAR(batch.scale_across[k], ray.scale_across, 1e-12 * scale);
        ASSERT_NEAR(batch.sky_direction(k).length(), 1, 1e-14);
      }
    }
  }
}

TEST(ViewTracer, TheDerivativeOfARayIsThatOfItsNeighbours) {
  std::mt19937 random(6);
  for (const Show& show : tracing_observers()) {
    const FrameState state = frame_state(show, 0);
    for (const bool lensing : {true, false}) {
      if (!lensing && !(state.observer.r > 2)) continue;
      Effects effects;
      effects.lensing = lensing;
      const ViewTracer tracer(state, WantedSkies{{true, true, true}}, effects);
      for (int k = 0; k < 300; ++k) {
        const V3d n = random_direction(random);
        expect_derivative_of_neighbours(tracer, n, random_direction(random), 1e-6);
      }
    }
  }
}

// The hole's edge as the renderer draws it, from the light side and from the dark.
TEST(ViewTracer, TheSilhouetteAtTheHorizonHas84Point2DegreesAcross) {
  const Show show = show_of(RadialInfall{2}, Domemaster{64});
  const FrameState state = frame_state(show, 0);
  const ViewTracer tracer(state, WantedSkies{});
  const double edge = std::acos(23.0 / 31);
  for (const double side : {-1e-9, 1e-9}) {
    const double delta = edge + side;
    const V3d n(-std::cos(delta), std::sin(delta), 0);
    const ViewRay ray = tracer.trace({apply_transposed(state.observer.tetrad_from_camera, n)});
    EXPECT_EQ(ray.sky, side > 0 ? SkyRegion::kI : SkyRegion::kIV);
    EXPECT_NEAR(ray.to_edge, 1e-9, 1e-13);
  }
}

// The sky is seen from inside with north up, so that Betelgeuse stands to the upper left of Rigel.
TEST(ViewTracer, OrionStandsUprightAndUnmirrored) {
  Show show = show_of(StaticObserver{}, Stereographic{800, 600, 40 * kDegree});
  const auto star = [](double ra, double dec) {
    return V3d(std::cos(dec * kDegree) * std::cos(ra * kDegree),
               std::cos(dec * kDegree) * std::sin(ra * kDegree), std::sin(dec * kDegree));
  };
  show.timeline[0].camera.attitude = LookAtSky{{star(84, 0)}};
  const FrameState state = frame_state(show, 0);
  const auto pixel = [&](const V3d& sky) {
    const V3d tetrad = apply_transposed(state.observer.sky_from_tetrad, sky);
    return pixel_of(show.projection, {apply_transposed(state.observer.tetrad_from_camera, tetrad)})
        .value();
  };
  const PixelPosition betelgeuse = pixel(star(88.79, 7.41)), rigel = pixel(star(78.63, -8.20));
  EXPECT_NEAR(betelgeuse.i, 306, 2);
  EXPECT_NEAR(betelgeuse.j, 153, 2);
  EXPECT_NEAR(rigel.i, 506, 2);
  EXPECT_NEAR(rigel.j, 463, 2);
}

// Far beyond the throat a screen that looks away from the mouth has the far sky as it would have
// it in flat space: what was ahead of it when the show began, upright and the right way round.
TEST(ViewTracer, TheFarSkyOfAWormholeStandsUprightAndUnmirrored) {
  const Projection screen = Stereographic{800, 600, 40 * kDegree};
  Show beyond = show_in_wormhole(-1e7, screen), home = show_of(StaticObserver{}, screen);
  beyond.heading = 90 * kDegree;  // so that what is up for the camera is north
  beyond.timeline[0].camera.attitude = home.timeline[0].camera.attitude = LookAtSky{beyond.hole_at};
  const FrameState far = frame_state(beyond, 0), near = frame_state(home, 0);
  const ViewTracer there(far, WantedSkies{}), here(near, WantedSkies{});
  for (const PixelPosition pixel : {PixelPosition{400.5, 300.5}, PixelPosition{700, 300},
                                    PixelPosition{400, 100}, PixelPosition{20, 560}}) {
    const CameraDirection n = direction_at(screen, pixel);
    const ViewRay seen = there.trace(n);
    EXPECT_EQ(seen.sky, SkyRegion::kIII);
    EXPECT_FALSE(seen.mirrored);
    EXPECT_LT((seen.sky_direction - here.trace(n).sky_direction).length(), 1e-6);
  }
}

// In the mouth, as in a window, the far sky is upright, and mirrored as little as around it.
TEST(ViewTracer, TheFarSkyStandsUprightInTheMouth) {
  Show show = show_in_wormhole(6, Stereographic{800, 600, 40 * kDegree});
  show.timeline[0].camera.attitude = LookAtHole{};
  const FrameState state = frame_state(show, 0);
  const ViewTracer tracer(state, WantedSkies{});
  const ViewRay middle = tracer.trace({V3d(0, 0, 1)});
  EXPECT_EQ(middle.sky, SkyRegion::kIII);
  EXPECT_LT((middle.sky_direction - show.hole_at.v).length(), 1e-9);
  const V3d &x = column(state.observer.tetrad_from_camera, 0),
            &y = column(state.observer.tetrad_from_camera, 1);
  for (const double angle : {0.5, 2.0, 4.0}) {
    const V3d aside = V3d(std::cos(angle), std::sin(angle), 0) * 1e-3;
    const ViewRay ray = tracer.trace({(V3d(0, 0, 1) + aside).normalized()});
    EXPECT_FALSE(ray.mirrored);
    const V3d to = apply(state.observer.sky_from_tetrad, x * aside.x + y * aside.y);
    EXPECT_GT((ray.sky_direction - show.hole_at.v).normalized().dot(to.normalized()), 0.999);
  }
}

}  // namespace
}  // namespace domefall
