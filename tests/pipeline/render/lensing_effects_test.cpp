// Shows without lensing or amplification, or with amplified backgrounds, as figures of [Riazuelo]
// app. app_img have them.  The tests ask what they show and where cameras point.
#include <gtest/gtest.h>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/show/attitude.h"
#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/effect_shows.h"

namespace domefall {
namespace {

// ---- lensing ----

// The caption of [Riazuelo] fig. fig_dev2 has z = -0.0339 at r = 30.
TEST(Effects, WithoutLensingTheSkyIsThatOfFlatSpaceABitBrighter) {
  const Effects straight{true, false, true, false, Amplification::kStars};
  const HalfFrame flat = render(at_rest_at(kFlatSpace, {})),
                  near = render(at_rest_at(30, straight));
  const double z = std::sqrt(1 - 2 / 30.0) - 1;
  ASSERT_NEAR(z, -0.0339, 5e-5);
  for (int y = 0; y < flat.height; ++y)
    for (int k = 0; k < 3 * flat.width; ++k)
      ASSERT_NEAR(near.row(y)[k] / double(flat.row(y)[k]), std::pow(1 + z, -4), 2e-3);
  StageTimes times;
  Renderer(at_rest_at(30, straight), 1).render(frame_state(at_rest_at(30, straight), 0), &times);
  EXPECT_EQ(times.table_nodes, 0u);
}

// The circular orbit at r = 6 has half the speed of light, and aberration and Doppler shift are
// those of flat space.
TEST(Effects, WithoutLensingMotionIsThatAgainstTheObserverAtRest) {
  Show show = show_of(CircularOrbit{6}, Domemaster{64});
  show.effects = kNoLensing;
  show.timeline[0].camera.attitude = LookAlongMotion{};
  const Traced traced(show);
  const ObserverState& o = traced.state.observer;
  const V3d ahead = target_direction(LookAlongMotion{}, o, show.effects).value();
  for (const double angle : {0.0, 0.4, 1.5, 3.0}) {
    const V3d m =
        ahead * std::cos(angle) + ahead.cross(V3d(1, 0, 0)).normalized() * std::sin(angle);
    const ViewRay ray = traced.tracer.trace({apply_transposed(o.tetrad_from_camera, m)});
    const V3d motion = apply(o.sky_from_tetrad, V3d(0, 0, 1));  // along Phi
    EXPECT_NEAR(ray.sky_direction.dot(motion), (std::cos(angle) - kV) / (1 - kV * std::cos(angle)),
                1e-14);
    EXPECT_NEAR(ray.frequency_ratio, std::sqrt(6 / 4.0) / (kGamma * (1 - kV * std::cos(angle))),
                1e-14);
    EXPECT_EQ(ray.sky, SkyRegion::kI);
  }
}

// A camera's target is seen in the middle, wherever the effects that are left put it.
TEST(Effects, CamerasFindTheirTargetWhereItIsDrawn) {
  const SkyDirection target{V3d(0.6, -0.64, 0.48)};
  for (const Trajectory& t : observers())
    for (const Effects& effects : combinations(is_outside(t))) {
      if (point_at(t, 0).region == Region::kIV) continue;  // no sky is seen there
      Show show = show_of(t, Stereographic{64, 48, 1});
      show.effects = effects;
      show.timeline[0].camera.attitude = LookAtSky{target};
      const ViewRay ray = Traced(show).tracer.trace({V3d(0, 0, 1)});
      const double scale = 1 + ray.scale_along + ray.scale_across;
      EXPECT_LT((ray.sky_direction - target.v).length(), 1e-8 * scale);
    }
}

TEST(Effects, WithoutAberrationMotionIsStillAhead) {
  Show show = show_of(CircularOrbit{6}, Stereographic{64, 48, 1});
  show.effects = {false, true, true, false, Amplification::kStars};
  show.timeline[0].camera.attitude = LookAlongMotion{};
  const Traced traced(show);
  const ViewRay ray = traced.tracer.trace({V3d(0, 0, 1)});
  const V3d along_phi = apply(traced.state.observer.sky_from_tetrad, V3d(0, 0, 1));
  EXPECT_LT((ray.sky_direction - along_phi).length(), 1e-14);
  EXPECT_NEAR(ray.frequency_ratio, std::sqrt(6 / 4.0) * std::sqrt(3), 1e-14);
}

// ---- stars ----

std::vector<StarImage> found_images(const Show& show, const V3d& sky) {
  const FrameState state = frame_state(show, 0);
  const SceneStar star{{sky}, 5, 1e-6, 6500, 1e-9};
  std::vector<StarImage> images;
  StarImageFinder(scene_with(show, state), SkyRegion::kI).append(star, images);
  return images;
}

V3d centre_of(const StarImage& image, const Projection& projection) {
  return direction_at(projection, {image.x + 1.0, image.y + 1.0}).v;
}

// A star is seen where the background shows its place, and its flux follows the background's law.
TEST(Effects, StarsAndBackgroundsObeyTheSameOptions) {
  std::mt19937 random(5);
  const Trajectory orbit = CircularOrbit{6};
  for (const Trajectory& t :
       {orbit, Trajectory(GivenVelocity{Region::kI, Tetrad::kRain, kFlatSpace, {0, 1, 2}})})
    for (const Effects& effects : combinations(true)) {
      Show show = show_of(t, Stereographic{2000, 2000, 300 * kDegree});
      show.effects = effects;
      const Traced traced(show);
      int seen = 0;
      for (int k = 0; k < 40; ++k) {
        const CameraDirection n{random_direction(random)};
        const ViewRay ray = traced.tracer.trace(n);
        if (n.v.z < -0.5 || ray.sky != SkyRegion::kI || ray.swept > 2.5) continue;
        const auto images = found_images(show, ray.sky_direction);
        ASSERT_FALSE(images.empty());
        const StarImage& image = images[0];
        EXPECT_LT((centre_of(image, show.projection) - n.v).length(), 1e-6);
        const double g = ray.frequency_ratio;
        double flux = 1e-6 * exposure_scale(frame_state(show, 0).settings);
        if (effects.intensity) flux *= g * g * g * g;
        if (effects.amplification != Amplification::kNone)
          flux /= ray.scale_along * ray.scale_across;
        const WorkingRgb c = blackbody_colours().per_flux(effects.doppler_colour ? 6500 * g : 6500);
        EXPECT_NEAR(image.rgb[1] / (flux * c.g), 1, 1e-5);
        ++seen;
      }
      EXPECT_GT(seen, 8);
    }
}

TEST(Effects, WithoutAmplificationBothImagesOfAStarAreAsBrightAsTheStar) {
  Show show = show_of(StaticObserver{30}, Stereographic{1000, 1000, 90 * kDegree});
  show.effects = {true, false, false, true, Amplification::kNone};
  const FrameState state = frame_state(show, 0);
  const V3d sky = apply(state.observer.sky_from_tetrad, V3d(-std::cos(0.1), std::sin(0.1), 0));
  const auto images = found_images(show, sky);
  ASSERT_EQ(images.size(), 2u);
  const V3d ahead(0, 0, 1);
  EXPECT_LT(centre_of(images[0], show.projection)
                .cross(ahead)
                .dot(centre_of(images[1], show.projection).cross(ahead)),
            0)
      << "on either side of the hole";
  const double flux = 1e-6 * exposure_scale(frame_state(show, 0).settings);
  for (const StarImage& image : images)
    EXPECT_NEAR(image.rgb[1] / (flux * blackbody_colours().per_flux(6500).g), 1, 1e-6);
  show.effects.amplification = Amplification::kStars;
  EXPECT_GT(found_images(show, sky)[0].rgb[1], 1.5 * images[0].rgb[1]);
}

// ---- amplification of backgrounds ----

// [Riazuelo] fig. fig_dev3.
TEST(Effects, AnAmplifiedBackgroundHasASmoothRingAndNoSpecks) {
  Show show = at_rest_at(30, {});
  show.projection = Stereographic{480, 360, 90 * kDegree};
  show.timeline[0].camera.attitude = LookAtHole{};
  show.sky[SkyRegion::kI].background =
      PanoramaSky{small_panorama(), 1, 0.0};  // without a black, so that each pixel has a ratio
  const HalfFrame natural = render(show);
  show.effects.amplification = Amplification::kEverything;
  const HalfFrame amplified = render(show);
  const Traced traced(show);
  const double pixel = largest_pixel_angle(show.projection);
  std::vector<double> peaks(360, 0);  // by the angle about the hole in degrees
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 480; ++x) {
      const ViewRay ray = traced.tracer.trace(direction_at(show.projection, {x + 1.0, y + 1.0}));
      if (ray.sky != SkyRegion::kI || ray.to_edge < 15 * pixel) continue;
      const double ratio = amplified.row(y)[3 * x + 1] / double(natural.row(y)[3 * x + 1]);
      const double off = std::abs(ray.swept - std::numbers::pi) / (ray.scale_along * pixel);
      if (off > 5) {
        const double expected = 1 / (ray.scale_along * ray.scale_across);
        // Both are blurred alike, but by different numbers of samples.
        ASSERT_NEAR(ratio / expected, 1, 0.04) << x << ' ' << y;
      } else {
        const double degrees = std::atan2(y - 179.5, x - 239.5) / kDegree;
        double& peak = peaks[static_cast<std::size_t>(std::lround(degrees + 360) % 360)];
        peak = std::max(peak, ratio);
      }
    }
  const double faintest = *std::min_element(peaks.begin(), peaks.end());
  const double brightest = *std::max_element(peaks.begin(), peaks.end());
  EXPECT_GT(faintest, 50);
  EXPECT_LT(brightest / faintest, 1.5);
}

}  // namespace
}  // namespace domefall
