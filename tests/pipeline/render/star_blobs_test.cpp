#include "pipeline/render/star_blobs.h"

#include <gtest/gtest.h>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/photometry.h"
#include "pipeline/render/star_images.h"
#include "scenes.h"

namespace domefall {
namespace {

// Sum over the picture of pixel value times solid angle: what the blob brings.
double drawn_flux(const StarBlob& blob, const Projection& p, bool whole_disc_only) {
  std::vector<float> row(static_cast<std::size_t>(columns(p)) * 3);
  double sum = 0;
  for (int y = blob.first_row; y <= blob.last_row; ++y) {
    std::fill(row.begin(), row.end(), 0.0f);
    draw_row(blob, p, y, row.data());
    for (int x = 0; x < columns(p); ++x) {
      const PixelPosition pixel{x + 1.0, y + 1.0};
      if (row[3 * static_cast<std::size_t>(x)] > 0 && !is_inside(p, pixel) && whole_disc_only)
        ADD_FAILURE() << "light outside the dome";
      sum += row[3 * static_cast<std::size_t>(x)] * pixel_solid_angle(p, pixel);
    }
  }
  return sum;
}

// One star of magnitude `m` in flat space, seen in a camera direction.
std::vector<StarBlob> blobs_of(const Show& show, const V3d& camera_direction, double m) {
  const FrameState state = frame_state(show, 0);
  const V3d sky = apply(state.observer.sky_from_tetrad,
                        apply(state.observer.tetrad_from_camera, camera_direction));
  const double t = 6500;
  const SceneStar star{{sky}, m, std::pow(10, -0.4 * m) * bolometric_flux_at_v_zero(t), t, 1e-9};
  std::vector<StarImage> images;
  StarImages(show, state, {1, 1, 40}, nullptr).append(star, images);
  const BlobWidths widths(show.blobs, state.projection, exposure_scale(state.picture));
  std::vector<StarBlob> blobs;
  for (const StarImage& image : images) {
    StarBlob blob{direction_at(state.projection, {image.x + 1.0, image.y + 1.0}),
                  widths.of(image),
                  {image.rgb[0], image.rgb[1], image.rgb[2]},
                  0,
                  0,
                  0,
                  0,
                  0};
    if (place_blob(state.projection, blob)) blobs.push_back(blob);
  }
  return blobs;
}

V3d dome_direction(double theta, double azimuth) {
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

// The promise: 1e-3, wherever the centre lies between pixels.
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
      for (const StarBlob& blob : blobs_of(show, n, m)) {
        const double flux = drawn_flux(blob, p, true);
        EXPECT_NEAR(flux / blob.rgb[0], 1, 1e-3) << n << " " << m;
      }
    }
  }
}

// At the rim half of a star is on the dome: with it and its mirror image a whole one.
TEST(StarBlobs, AtTheRimAreCutNotDimmed) {
  const Projection p = Domemaster{1024};
  const Show show = show_of(StaticObserver{}, p);
  for (double azimuth : {0.0, 0.3, 1.57, 4.0}) {
    const double off = 0.07 * kDegree;
    double sum = 0, each = 0;
    for (double theta : {90 * kDegree - off, 90 * kDegree + off})
      for (const StarBlob& blob : blobs_of(show, dome_direction(theta, azimuth), 4)) {
        sum += drawn_flux(blob, p, true);
        each = blob.rgb[0];
      }
    // The rim's pixels are in or out as a whole: a staircase across the blob.
    EXPECT_NEAR(sum / each, 1, 0.1) << azimuth;
  }
}

TEST(StarBlobs, AreRoundOnTheDome) {
  const Projection p = Domemaster{2048};
  const Show show = show_of(StaticObserver{}, p);
  const auto blobs = blobs_of(show, dome_direction(80 * kDegree, 0), 0);
  ASSERT_EQ(blobs.size(), 1u);
  const StarBlob& blob = blobs[0];
  double along = 0, across = 0, sum = 0;
  std::vector<float> row(2048 * 3);
  for (int y = blob.first_row; y <= blob.last_row; ++y) {
    std::fill(row.begin(), row.end(), 0.0f);
    draw_row(blob, p, y, row.data());
    for (int x = blob.first_column; x <= blob.last_column; ++x) {
      const PixelPosition pixel{x + 1.0, y + 1.0};
      const double w = row[3 * static_cast<std::size_t>(x)] * pixel_solid_angle(p, pixel);
      const V3d d = direction_at(p, pixel).v - blob.centre.v;
      const V3d up = dome_direction(170 * kDegree, 0);  // towards the rim
      along += w * d.dot(up) * d.dot(up), across += w * d.y * d.y, sum += w;
    }
  }
  EXPECT_NEAR(std::sqrt(along / across), 1, 2e-3);
  // Cut at 4.5 sigma and lowered to 0 there, the Gaussian is 0.1 % narrower.
  EXPECT_NEAR(std::sqrt(across / sum) / blob.sigma, 1, 3e-3);
}

TEST(StarBlobs, GrowWithBrightnessByTheLawOfTheShow) {
  const Show show = show_of(StaticObserver{}, Domemaster{8192});
  const auto sigma = [&show](double m) {
    return blobs_of(show, dome_direction(0.5, 1), m).at(0).sigma;
  };
  EXPECT_NEAR(sigma(6), 0.05 * kDegree, 1e-12);
  EXPECT_NEAR(sigma(1) / sigma(2), std::pow(10, 0.4 * show.blobs.growth), 1e-3);
  EXPECT_NEAR(sigma(-20), 0.3 * kDegree, 1e-12);
}

// A star of V = 0 brings 2.63e-6 lux at about 5800 K.
TEST(StarBlobs, OfMagnitudeZeroBringTheIlluminanceOfTheMagnitudeScale) {
  Show show = show_of(StaticObserver{}, Domemaster{1024});
  const auto blobs = blobs_of(show, dome_direction(0.5, 1), 0);
  const WorkingRgb c{blobs.at(0).rgb[0], blobs[0].rgb[1], blobs[0].rgb[2]};
  EXPECT_NEAR(luminance(c) / exposure_scale(Picture{}), kMagnitudeZeroLux,
              0.02 * kMagnitudeZeroLux);
}

// [Riazuelo]: the k-th image. Behind the hole every star of a plane has two bright images, and
// their separations from the hole obey the lens equation far away: theta1 * theta2 = theta_E^2.
TEST(StarBlobs, FarFromTheHoleTheTwoImagesObeyTheLensEquation) {
  const double r = 1e6;
  const HoleOptics optics = make_hole_optics(r, Tetrad::kRain, {});
  const double beta = 1e-3;
  const V3d source(-std::cos(beta), std::sin(beta), 0);
  const V3d one = image_of(&*optics.home_sky, source, 0, 1e-9).direction.v,
            two = image_of(&*optics.home_sky, source, 1, 1e-9).direction.v;
  const double theta1 = std::atan2(one.y, -one.x), theta2 = -std::atan2(two.y, -two.x);
  const double einstein2 = 4 / r;
  EXPECT_NEAR(theta1 * theta2 / einstein2, 1, 0.01);
  EXPECT_NEAR((theta1 - theta2) / beta, 1, 0.01);
}

}  // namespace
}  // namespace domefall
