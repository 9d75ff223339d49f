
#include <gtest/gtest.h>

#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/stars/star_scene.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kTemperature = 5800;

SceneStar bright_star(const SkyDirection& direction) {
  return {direction, 0, bolometric_flux_at_v_zero(kTemperature), kTemperature, 1e-9};
}

// The light of an even disc, summed over the directions in which it is seen in the frame of the
// tetrad.  For each angle from the hole the lens gives the angle from the axis at which the light
// started, and the part of that circle that lies in the disc follows from geometry.
double light_of_disc(const SkyTable& table, const SceneStar& star, double from_axis, double radius,
                     double scale) {
  constexpr int kAngles = 3'000;
  double sum = 0;
  for (int axis = 1; axis < 8;
       axis += 2) {  // light from behind the hole sweeps odd multiples of pi
    const double first = table.distance(axis * pi + from_axis + radius);
    const double last = table.distance(std::max(0.0, axis * pi - from_axis - radius));
    const double from = 4 * std::atan(first / 2);
    const double step = (4 * std::atan(last / 2) - from) / kAngles;
    for (int k = 0; k < kAngles; ++k) {
      const double x = 2 * std::tan((from + (k + 0.5) * step) / 4);
      const double q = std::abs(table.azimuth(x) - axis * pi);
      // The circle at q from the axis meets the disc's rim where cos(radius) = cos q cos b + sin q
      // sin b cos(azimuth), b = from_axis.  For small angles this is the law of cosines of the
      // plane.
      const double cosine =
          (q * q + from_axis * from_axis - radius * radius) / (2 * q * std::max(from_axis, 1e-30));
      const double width = 2 * std::acos(std::clamp(cosine, -1.0, 1.0));
      const ZoneRay ray = table.ray_at_distance(x);
      const double g = 1 / ray.one_plus_z;
      const double shine =
          luminance(blackbody_colours().per_flux(star.temperature * g)) * g * g * g * g;
      sum += ray.sine() * step * width * shine;
    }
  }
  return sum * star.flux * scale / (pi * radius * radius);
}

struct Sweep {
  Region region;
  double r;
  bool far;
};

// A star passes behind the hole.
TEST(EinsteinRings, HaveTheLightOfADiscAcrossTheAxis) {
  for (const Sweep& s :
       {Sweep{Region::kI, 1e8, false}, Sweep{Region::kI, 1e6, false}, Sweep{Region::kI, 1e3, false},
        Sweep{Region::kI, 10, false}, Sweep{Region::kI, 2.5, false}, Sweep{Region::kII, 1, false},
        Sweep{Region::kII, 1, true}}) {
    StarScene scene({s.region, Tetrad::kRain, s.r, {0, 0, 0}}, Domemaster{1024});
    const double disc = scene.show.least_star_radius = 0.16 * kDegree;
    const StarImageFinder maker = scene.images(s.far);
    double before = 0;
    for (int k = -60; k <= 10; ++k) {
      const double from_axis = 0.2 * disc * std::abs(k);
      // append(star) finds images beside the frame too, so the light is that of the whole sphere.
      const SceneStar star = bright_star(
          scene.sky(V3d(-std::cos(from_axis), std::sin(from_axis) * (k < 0 ? -1 : 1), 0)));
      std::vector<StarImage> images;
      maker.append(star, images);
      const double total = total_light(images);
      ASSERT_TRUE(std::isfinite(total));
      const double wanted =
          light_of_disc(*scene.table(s.far), star, from_axis, disc, scene.exposure());
      EXPECT_NEAR(total / wanted, 1, 0.01)
          << "r " << s.r << (s.far ? " far" : "") << ", " << 0.2 * k << " radii from the axis";
      // The light is largest in line, and has no step between two places 0.2 radii apart.
      if (k > -60) {
        EXPECT_NEAR(total / before, 1, 0.4) << "r " << s.r << ", " << k;
        if (s.r < 1e8) {
          EXPECT_LT((total - before) * (k <= 0 ? -1 : 1), 0.003 * total) << "r " << s.r << " " << k;
        }
      }
      before = total;
    }
  }
}

// In line the image is Einstein's ring, which is even, closed and everywhere at one angle from the
// hole.
TEST(EinsteinRings, InLineAreARing) {
  const StarScene scene({Region::kI, Tetrad::kRain, 30, {0, 0, 0}}, Domemaster{1024});
  std::vector<StarImage> images;
  scene.images().append(bright_star(scene.sky(V3d(-1, 0, 0))), images);
  const V3d hole = apply_transposed(scene.state.observer.tetrad_from_camera, V3d(-1, 0, 0));
  const double pixel = largest_pixel_angle(scene.state.projection);
  const SkyTable& table = *scene.table(false);
  const double ring = table.ray_at_distance(table.distance(pi)).half.angle();
  std::vector<StarImage> outer;
  for (const StarImage& image : images) {
    const V3d n = direction_at(scene.state.projection, {image.x + 1.0, image.y + 1.0}).v;
    const double angle = 2 * std::asin((n - hole).length() / 2);
    if (angle > ring - 3 * pixel) {
      EXPECT_NEAR(angle, ring, 0.6 * pixel);
      outer.push_back(image);
    }
  }
  // Orders 0 and 1 are the same ring, each in pieces 1.5 sigma apart, with sigma = 0.9 pixel.
  EXPECT_NEAR(static_cast<double>(outer.size()), 2 * 2 * pi * std::sin(ring) / (1.5 * 0.9 * pixel),
              6);
  const std::size_t half = outer.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    const StarImage &here = outer[k], &next = outer[(k + 1) % half];
    EXPECT_LT(std::hypot(here.x - next.x, here.y - next.y), 2.5) << "a gap";
    EXPECT_NEAR(light(here) / light(outer[0]), 1, 1e-3);
  }
}

// As the star leaves the axis, its arc shrinks to a point.
TEST(EinsteinRings, BecomePoints) {
  StarScene scene({Region::kI, Tetrad::kRain, 10, {0, 0, 0}}, Domemaster{1024});
  const double disc = scene.show.least_star_radius = 0.16 * kDegree;
  const auto longest = [&](double radii) {
    std::vector<StarImage> images;
    const V3d source(-1, radii * disc * 0.6, radii * disc * 0.8);
    scene.images().append(bright_star(scene.sky(source)), images);
    // The pieces of order 0 come first, without a gap between them.
    double length = 0;
    for (std::size_t k = 1; k < images.size(); ++k) {
      const double step = std::hypot(images[k].x - images[k - 1].x, images[k].y - images[k - 1].y);
      if (step > 4) break;
      length += step;
    }
    return length;
  };
  double before = longest(1.6);
  EXPECT_GT(before, 20);
  for (double radii = 1.65; radii < 3; radii += 0.05) {
    const double length = longest(radii);
    EXPECT_LT(length, before + 1);
    EXPECT_GT(length, before - 25);
    before = length;
  }
  EXPECT_LT(before, 6);
}

// Region III with all its stars appears at the horizon as a point at 1+z = 0.  Towards that moment
// the bolometric flux of its stars rises to infinity.  But the visible light of so hot a source
// grows like its temperature only, and the solid angle shrinks faster, so that the visible flux
// falls like 1+z.
TEST(EinsteinRings, OfTheFirstLightOfRegionThreeAreFiniteAndOrdered) {
  std::mt19937 random(2);
  std::vector<SceneStar> list;
  for (int k = 0; k < 300; ++k) list.push_back(bright_star({random_direction(random)}));
  const SceneStars stars(list);
  double before = 0;
  for (int k = 1; k <= 12; ++k) {
    const StarScene scene({Region::kII, Tetrad::kRain, 2 - std::pow(10, -k), {0, 0, 0}},
                          Domemaster{256}, 30);
    ASSERT_TRUE(scene.has(true));
    const auto images = all_images(scene.images(true), stars);
    ASSERT_FALSE(images.empty());
    for (const StarImage& image : images) {
      ASSERT_TRUE(std::isfinite(image.x) && std::isfinite(image.y));
      for (const float c : image.rgb) ASSERT_TRUE(std::isfinite(c) && c >= 0);
    }
    const double total = total_light(images);
    EXPECT_GT(total, 0);
    if (k > 6) {
      EXPECT_NEAR(total / before, 0.1, 0.01) << k;
    }
    before = total;
  }
}

}  // namespace
}  // namespace domefall
