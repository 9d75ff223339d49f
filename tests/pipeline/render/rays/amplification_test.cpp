#include "pipeline/light/amplification.h"

#include <gtest/gtest.h>

#include "pipeline/light/schwarzschild_zone.h"
#include "pipeline/render/rays/view_tracer.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

using std::numbers::pi;

struct Scene30 {
  explicit Scene30(const Trajectory& trajectory, const Projection& p = Domemaster{64})
      : show(show_of(trajectory, p)), state(frame_state(show, 0)), tracer(state, WantedSkies{}) {}
  Show show;
  FrameState state;
  ViewTracer tracer;
};

// [Riazuelo] eq. eq_ampl in the limit of a small image, by both forms of the Jacobian.
TEST(Amplification, OfSmallImagesIsTheInverseOfTheJacobian) {
  std::mt19937 random(11);
  for (const Trajectory& t :
       {Trajectory(StaticObserver{30}), Trajectory(CircularOrbit{6}), Trajectory(RadialInfall{1.2}),
        Trajectory(GivenVelocity{Region::kI, Tetrad::kOutgoing, 5, {1, 2, 3}})}) {
    const Scene30 scene(t);
    int seen = 0;
    for (int k = 0; k < 500; ++k) {
      const ViewRay ray = scene.tracer.trace({random_direction(random)});
      if (ray.sky == SkyRegion::kIV || ray.to_edge < 0.01) continue;
      const double doppler = ray.bundle.doppler;
      const auto& [angle, azimuth, slope] = std::get<AxisPatch>(ray.bundle.patch);
      const double sine = std::abs(std::sin(azimuth));
      if (sine < 0.01) continue;
      ++seen;
      const double formula = std::sin(angle) / (sine * slope * doppler * doppler);
      const double f = amplification(ray.bundle, 1e-7);
      EXPECT_NEAR(f / formula, 1, 1e-9);
      EXPECT_NEAR(f * ray.scale_along * ray.scale_across, 1, 1e-9);
    }
    EXPECT_GT(seen, 30);
  }
}

// Stars and backgrounds are magnified alike, though the stars' images come from other code.
TEST(Amplification, IsThatOfAStarSeenThere) {
  std::mt19937 random(12);
  const Scene30 scene(RadialInfall{30});
  const auto points = scene.tracer.lens()->points(SkyRegion::kI, {});
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const CameraDirection n{random_direction(random)};
    const ViewRay ray = scene.tracer.trace(n);
    if (ray.sky != SkyRegion::kI || ray.swept > 3) continue;
    const V3d source = apply_transposed(scene.state.observer.sky_from_tetrad, ray.sky_direction);
    const SkyImage image = points->image(source, 0, 1e-9);
    // The table's slope is good to 1e-7.
    EXPECT_NEAR(amplification(ray.bundle, 1e-7) / image.amplification, 1, 1e-6);
    ++seen;
  }
  EXPECT_GT(seen, 100);
}

// Each ring of the image covers as much of the sky as its amplification says.  Azimuths from 0 to
// 3 pi/2 pass over the whole sky once, across an Einstein ring, and over half of it again.
TEST(Amplification, AccountsForTheWholeSkyAcrossTheEinsteinRing) {
  const SkyTable table(schwarzschild_zone(30.0, Critical::kFirst));
  const double last = table.distance(1.5 * pi);
  const double from = table.zone().edge.half.angle() + 4 * std::atan(last / 2);
  for (const int rings : {200, 2000}) {
    const double width = (pi - from) / rings;
    double covered = 0;
    for (int k = 0; k < rings; ++k) {
      const double angle = from + (k + 0.5) * width;
      const double x = 2 * std::tan((angle - table.zone().edge.half.angle()) / 4);
      const double solid_angle =
          2 * pi * (std::cos(angle - width / 2) - std::cos(angle + width / 2));
      covered +=
          solid_angle / amplification({AxisPatch{angle, table.azimuth(x), table.slope(x)}}, width);
    }
    // The azimuth is taken for straight across a ring: an error of second order (measured: 390).
    EXPECT_NEAR(covered / (6 * pi), 1, 500.0 / (rings * rings)) << rings;
  }
}

// The same holds for the pixels of a dome.  At half the speed of light the half sphere ahead, 2 pi,
// holds 3 pi of the sky, since cos alpha = -v at its rim.
TEST(Amplification, AccountsForTheSkyOnADomeWithAberration) {
  const GivenVelocity half{Region::kI, Tetrad::kRain, kFlatSpace, {0, 0, 0.5 / std::sqrt(0.75)}};
  Scene30 scene(half, Domemaster{256});
  scene.show.timeline[0].camera.attitude = LookAlongMotion{};
  scene.show.timeline[0].camera.elevation = 90 * kDegree;
  const FrameState state = frame_state(scene.show, 0);
  const ViewTracer tracer(state, WantedSkies{});
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
            const double f = amplification({AxisPatch{angle, azimuth, slope}, doppler}, width);
            EXPECT_TRUE(std::isfinite(f) && f > 0)
                << angle << ' ' << azimuth << ' ' << slope << ' ' << doppler << ' ' << width;
          }
  // |sin| averaged over a zero and h to either side is h/2.
  EXPECT_NEAR(amplification({AxisPatch{0.3, pi, 1}}, 1e-4), std::sin(0.3) / 2.5e-5, 1e-3);
  // The point opposite an axis is no caustic.
  EXPECT_NEAR(amplification({AxisPatch{pi, 0, 2}}, 1e-4), 0.25, 1e-8);
}

// Away from the ends of its axis a lens may as well be described without it.  Across an image the
// area then changes evenly: |sin azimuth| slope/sin angle has the derivative slope^2/sin angle where
// the azimuth is pi.
TEST(Amplification, OfALensWithoutAnAxisIsThatWithOneForSmallImages) {
  const double angle = 0.7, slope = 3, doppler = 1.2, width = 1e-3, sine = std::sin(angle);
  const double half = slope * doppler * width / 2;  // of the azimuths that the width sweeps
  for (const double off : {0.0, 0.2 * half, half, 3 * half, 0.1}) {
    const double with_axis = amplification({AxisPatch{angle, pi + off, slope}, doppler}, width);
    const SkyPatch patch{std::sin(off) * slope / sine, std::cos(off) * slope * slope / sine};
    EXPECT_NEAR(amplification({patch, doppler}, width) / with_axis, 1, 1e-6) << off;
  }
}

}  // namespace
}  // namespace domefall
