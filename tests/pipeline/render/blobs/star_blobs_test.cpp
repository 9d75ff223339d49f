#include <gtest/gtest.h>

#include "pipeline/render/scene/exposure.h"
#include "pipeline/render/stars/star_image_finder.h"
#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/blobs/drawn_blobs.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

// The image of a star of magnitude `m` in flat space, seen in a direction of the camera.
StarImage image_of_star(const Show& show, const V3d& camera_direction, double m) {
  FrameState state = frame_state(show, 0);
  state.settings.sky[SkyRegion::kI] = {1, 1, 40};
  const V3d sky = apply(state.observer.sky_from_tetrad,
                        apply(state.observer.tetrad_from_camera, camera_direction));
  const double t = 6500;
  const SceneStar star{{sky}, m, std::pow(10, -0.4 * m) * bolometric_flux_at_v_zero(t), t, 1e-9};
  std::vector<StarImage> images;
  StarImageFinder(scene_with(show, state), SkyRegion::kI).append(star, images);
  return images.at(0);
}

PointSpread blob_widths(const Show& show) {
  return {show.point_spread, frame_state(show, 0).projection, exposure_scale(FrameSettings{})};
}

V3d dome_direction(double theta, double azimuth) {
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

// The light is right to 1e-3 wherever the centre lies between pixels, for the whole path from a
// catalogue's star to the pixels.
TEST(StarBlobs, BringTheSameFluxWhereverTheyLieBetweenPixels) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  for (const Projection& p : {Projection(Domemaster{512}), Projection(Domemaster{2048}),
                              Projection(Stereographic{640, 360, 2.0})}) {
    const Show show = show_of(StaticObserver{}, p);
    for (int k = 0; k < 60; ++k) {
      const bool dome = std::holds_alternative<Domemaster>(p);
      const V3d n =
          dome_direction((dome ? 86 : 25) * kDegree * u(random), 2 * std::numbers::pi * u(random));
      const double m = 6 - 7 * u(random);
      const StarImage image = image_of_star(show, n, m);
      EXPECT_NEAR(brought(image, p, blob_widths(show)).flux / image.rgb[0], 1, 1e-3)
          << n << " " << m;
    }
  }
}

// A star within the rim and another as far outside it together bring the light of one.
TEST(StarBlobs, AtTheRimAreCutNotDimmed) {
  const Projection p = Domemaster{1024};
  const Show show = show_of(StaticObserver{}, p);
  for (const double m : {4.0, 10.0})
    for (double azimuth : {0.0, 0.3, 1.57, 4.0}) {
      const double off = 0.07 * kDegree;
      double sum = 0;
      for (double theta : {90 * kDegree - off, 90 * kDegree + off}) {
        const StarImage image = image_of_star(show, dome_direction(theta, azimuth), m);
        sum += brought(image, p, blob_widths(show)).flux / image.rgb[0];
      }
      // The rim's pixels are in or out as a whole: a staircase across the blob.
      EXPECT_NEAR(sum, 1, 0.1) << azimuth << " " << m;
    }
}

TEST(StarBlobs, AreRoundOnTheDome) {
  const Projection p = Domemaster{2048};
  Show show = show_of(StaticObserver{}, p);
  show.point_spread.min_sigma = 0.15 * kDegree;
  for (const double m : {10.0, 0.0}) {
    const StarImage image = image_of_star(show, dome_direction(80 * kDegree, 0), m);
    const V3d centre = direction_at(p, {image.x + 1.0, image.y + 1.0}).v;
    const DrawnBlobs blob = drawn({image}, p, blob_widths(show));
    double along = 0, across = 0, sum = 0;
    for (int y = 924; y < 1124; ++y)
      for (int x = 1800; x < 2048; ++x) {
        const PixelPosition pixel{x + 1.0, y + 1.0};
        const double w = blob.at(y, x) * pixel_solid_angle(p, pixel);
        const V3d d = direction_at(p, pixel).v - centre;
        const V3d up = dome_direction(170 * kDegree, 0);  // towards the rim
        along += w * d.dot(up) * d.dot(up);
        across += w * d.y * d.y;
        sum += w;
      }
    // In angle a pixel there is 1 by 0.705 central pixels, and blurs the star by that.
    const double pixel = largest_pixel_angle(p);
    along -= sum * pixel * pixel / 12;
    across -= sum * pixel * pixel * 0.705 * 0.705 / 12;
    EXPECT_NEAR(std::sqrt(along / across), 1, 2e-3) << m;
    // Cut at 3.5 sigma and lowered to 0 there, the Gaussian is 1 % narrower.
    const double sigma = blob_widths(show).sigma_of(image);
    EXPECT_NEAR(std::sqrt(across / sum) / sigma, 1, 0.03) << m;
  }
}

TEST(StarBlobs, GrowWithBrightnessByTheLawOfTheShow) {
  const Show show = show_of(StaticObserver{}, Domemaster{8192});
  const auto sigma = [&show](double m) {
    return blob_widths(show).sigma_of(image_of_star(show, dome_direction(0.5, 1), m));
  };
  EXPECT_NEAR(sigma(6), 0.05 * kDegree, 1e-12);
  EXPECT_NEAR(sigma(1) / sigma(2), std::pow(10, 0.4 * show.point_spread.growth), 1e-3);
  EXPECT_NEAR(sigma(-20), 0.3 * kDegree, 1e-12);
}

// With a halo all middles have the least width, and the halo's light is missing in the middle.
TEST(StarBlobs, WithAHaloKeepTheirLight) {
  const Projection p = Domemaster{1024};
  Show show = show_of(StaticObserver{}, p);
  show.point_spread.halo = 0.2;
  show.point_spread.halo_sigma = 0.5 * kDegree;
  double before = 0;
  for (double m = 12; m > -6; m -= 0.25) {
    const StarImage image = image_of_star(show, dome_direction(0.5, 1), m);
    const PointSpreadParts parts = blob_widths(show).parts(image);
    EXPECT_EQ(parts.sigma, blob_widths(show).least());
    EXPECT_NEAR(brought(image, p, blob_widths(show), 120).flux / image.rgb[0], 1, 1e-3) << m;
    const double share = parts.halo[0].share + parts.halo[1].share + parts.halo[2].share;
    EXPECT_NEAR(parts.image.rgb[0] / image.rgb[0], 1 - share, 1e-6);
    EXPECT_GE(share, before) << m;
    before = share;
  }
  EXPECT_NEAR(before, 0.2, 1e-3);
}

// [Riazuelo] sec. sec_stars_eff: the centre of a bright blob is less saturated than its edge.
TEST(StarBlobs, PaleInTheirMiddleOnly) {
  const Projection p = Domemaster{1024};
  PointSpreadLaw law{0.003, 0, 40, 0.003};
  law.white_core = 10;
  const PointSpread widths(law, p, 1e3);
  const auto flux = static_cast<float>(flux_of_peak(widths, 1000));
  const StarImage image{500, 500, {0.3f * flux, 0.6f * flux, flux}};
  const DrawnBlobs blob = drawn({image}, p, widths);
  const auto blue = [&](int x) { return blob.at(500, x, 2) / blob.at(500, x, 0); };
  EXPECT_NEAR(blue(500), 1, 0.01);
  const auto edge = [&](int x) { return blob.at(500, x, 1) > 0.01f; };
  int x = 500;
  while (edge(x + 1)) ++x;
  EXPECT_GT(x, 503);
  EXPECT_NEAR(blue(x), 1 / 0.3, 0.01);
  // Its luminance is that of a blob that keeps its colour.
  law.white_core = 0;
  const DrawnBlobs own = drawn({image}, p, PointSpread(law, p, 1e3));
  for (int at = 490; at < 511; ++at) {
    const auto light = [at](const DrawnBlobs& d) {
      return luminance({d.at(500, at, 0), d.at(500, at, 1), d.at(500, at, 2)});
    };
    EXPECT_NEAR(light(blob), light(own), 3e-4 * light(own) + 1e-6) << at;
  }
}

// Sizes are angles, so that an image of twice the size, averaged over 2 by 2 pixels, shows the same
// star.
TEST(StarBlobs, AreTheSameInAnImageOfTwiceTheSize) {
  Show show = show_of(StaticObserver{}, Domemaster{1024});
  show.point_spread.min_sigma = 0.3 * kDegree;
  show.point_spread.max_sigma = 0.6 * kDegree;
  const Projection coarse = Domemaster{1024}, fine = Domemaster{2048};
  for (const double m : {9.0, 1.0}) {
    const StarImage image = image_of_star(show, dome_direction(1.1, 2), m);
    StarImage twice = image;
    twice.x = 2 * image.x + 0.5f;
    twice.y = 2 * image.y + 0.5f;
    const double scale = exposure_scale(FrameSettings{});
    const DrawnBlobs one = drawn({image}, coarse, PointSpread(show.point_spread, coarse, scale)),
                     other = drawn({twice}, fine, PointSpread(show.point_spread, fine, scale));
    const int y = static_cast<int>(image.y), x = static_cast<int>(image.x);
    const float peak = one.at(y, x);
    for (int j = y - 8; j < y + 8; ++j)
      for (int i = x - 8; i < x + 8; ++i) {
        const float mean = (other.at(2 * j, 2 * i) + other.at(2 * j, 2 * i + 1) +
                            other.at(2 * j + 1, 2 * i) + other.at(2 * j + 1, 2 * i + 1)) /
                           4;
        EXPECT_NEAR(one.at(j, i) / peak, mean / peak, 0.005) << m << " " << i << " " << j;
      }
  }
}

// A star of V = 0 brings 2.63e-6 lux at about 5800 K.
TEST(StarBlobs, OfMagnitudeZeroBringTheIlluminanceOfTheMagnitudeScale) {
  Show show = show_of(StaticObserver{}, Domemaster{1024});
  const StarImage image = image_of_star(show, dome_direction(0.5, 1), 0);
  const WorkingRgb c{image.rgb[0], image.rgb[1], image.rgb[2]};
  EXPECT_NEAR(luminance(c) / exposure_scale(FrameSettings{}), kMagnitudeZeroLux,
              0.02 * kMagnitudeZeroLux);
}

}  // namespace
}  // namespace domefall
