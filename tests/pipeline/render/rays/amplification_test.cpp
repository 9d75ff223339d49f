#include "pipeline/render/rays/amplification.h"

#include <gtest/gtest.h>

#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct Scene30 {
  explicit Scene30(const Trajectory& trajectory, const Projection& p = Domemaster{64})
      : show(show_of(trajectory, p)),
        state(frame_state(show, 0)),
        optics(make_hole_optics(state.observer.r, state.observer.tetrad, {true, true})),
        tracer(state, optics) {}
  Show show;
  FrameState state;
  HoleOptics optics;
  ViewTracer tracer;
};

// [Riazuelo] eq. eq_ampl in the limit of a small image, by both forms of the Jacobian.
TEST(Amplification, OfSmallImagesIsTheInverseOfTheJacobian) {
  std::mt19937 random(11);
  for (const Trajectory& t :
       {Trajectory(StaticObserver{30}), Trajectory(CircularOrbit{6}), Trajectory(RadialInfall{1.2}),
        Trajectory(GivenVelocity{Region::kI, Tetrad::kOutgoing, 5, V3d(1, 2, 3)})}) {
    const Scene30 scene(t);
    int seen = 0;
    for (int k = 0; k < 500; ++k) {
      const ViewRay ray = scene.tracer.trace({random_direction(random)});
      if (ray.sky == SkyRegion::kIV || ray.to_edge < 0.01) continue;
      const RayBundle& b = ray.bundle;
      const double sine = std::abs(std::sin(b.azimuth));
      if (sine < 0.01) continue;
      ++seen;
      const double formula = std::sin(b.angle) / (sine * b.slope * b.doppler * b.doppler);
      const double f = amplification(b, 1e-7);
      EXPECT_NEAR(f / formula, 1, 1e-9);
      EXPECT_NEAR(f * ray.radial_scale * ray.tangential_scale, 1, 1e-9);
    }
    EXPECT_GT(seen, 30);
  }
}

// Stars and backgrounds are magnified alike, though the stars' images come from other code.
TEST(Amplification, IsThatOfAStarSeenThere) {
  std::mt19937 random(12);
  const Scene30 scene(RadialInfall{30});
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const CameraDirection n{random_direction(random)};
    const ViewRay ray = scene.tracer.trace(n);
    if (ray.sky != SkyRegion::kI || ray.bundle.azimuth > 3) continue;
    const V3d source = apply_transposed(scene.state.observer.sky_from_tetrad, ray.sky_direction);
    const SkyImage image = image_of(&*scene.optics.home_sky, source, 0, 1e-9);
    // The table's slope is good to 1e-7.
    EXPECT_NEAR(amplification(ray.bundle, 1e-7) / image.amplification, 1, 1e-6);
    ++seen;
  }
  EXPECT_GT(seen, 100);
}

// Each ring of the image covers as much of the sky as its amplification says.  Azimuths from 0 to
// 3 pi/2 pass over the whole sky once, across an Einstein ring, and over half of it again.
TEST(Amplification, AccountsForTheWholeSkyAcrossTheEinsteinRing) {
  const SkyTable table(30.0, Critical::kFirst);
  const double last = table.distance(1.5 * pi);
  const double from = table.edge_angle() + 4 * std::atan(last / 2);
  for (const int rings : {200, 2000}) {
    const double width = (pi - from) / rings;
    double covered = 0;
    for (int k = 0; k < rings; ++k) {
      const double angle = from + (k + 0.5) * width;
      const double x = 2 * std::tan((angle - table.edge_angle()) / 4);
      const double solid_angle =
          2 * pi * (std::cos(angle - width / 2) - std::cos(angle + width / 2));
      covered += solid_angle / amplification({angle, table.azimuth(x), table.slope(x), 1}, width);
    }
    // The azimuth is taken for straight across a ring: an error of second order (measured: 390).
    EXPECT_NEAR(covered / (6 * pi), 1, 500.0 / (rings * rings)) << rings;
  }
}

// The same holds for the pixels of a dome.  At half the speed of light the half sphere ahead, 2 pi,
// holds 3 pi of the sky, since cos alpha = -v at its rim.
TEST(Amplification, AccountsForTheSkyOnADomeWithAberration) {
  const GivenVelocity half{Region::kI, Tetrad::kRain, kFlatSpace, V3d(0, 0, 0.5 / std::sqrt(0.75))};
  Scene30 scene(half, Domemaster{256});
  scene.show.timeline[0].camera.attitude = LookAlongMotion{};
  scene.show.timeline[0].camera.elevation = 90 * kDegree;
  const FrameState state = frame_state(scene.show, 0);
  const ViewTracer tracer(state, scene.optics);
  double sky = 0;
  for (int j = 1; j <= 256; ++j)
    for (int i = 1; i <= 256; ++i) {
      const PixelPosition at{double(i), double(j)};
      if (!is_inside(scene.show.projection, at)) continue;
      const ViewRay ray = tracer.trace(direction_at(scene.show.projection, at));
      sky += pixel_solid_angle(scene.show.projection, at) /
             amplification(ray.bundle, pixel_angle(scene.show.projection, at));
    }
  // Pixels of the rim are in or out as a whole.
  EXPECT_NEAR(sky / (3 * pi), 1, 2e-3);
}

TEST(Amplification, IsFiniteOnEveryCausticAndOfTheOrderOfOneOverTheWidth) {
  for (const double angle : {1e-12, 0.3, pi})
    for (const double azimuth : {0.0, 1e-13, pi, 2 * pi, 9 * pi})
      for (const double slope : {1e-3, 1.0, 1e6, 1e17})
        for (const double doppler : {1e-9, 1.0, 1e9})
          for (const double width : {1e-9, 1e-3, 1.0}) {
            const double f = amplification({angle, azimuth, slope, doppler}, width);
            EXPECT_TRUE(std::isfinite(f) && f > 0)
                << angle << ' ' << azimuth << ' ' << slope << ' ' << doppler << ' ' << width;
          }
  // |sin| averaged over a zero and h to either side is h/2.
  EXPECT_NEAR(amplification({0.3, pi, 1, 1}, 1e-4), std::sin(0.3) / 2.5e-5, 1e-3);
  // The point opposite an axis is no caustic.
  EXPECT_NEAR(amplification({pi, 0, 2, 1}, 1e-4), 0.25, 1e-8);
}

}  // namespace
}  // namespace domefall
