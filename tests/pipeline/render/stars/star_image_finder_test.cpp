#include "pipeline/render/stars/star_image_finder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/render/blobs/cap_blob.h"
#include "pipeline/render/stars/blackbody_table.h"
#include "pipeline/sources/colour/blackbody.h"
#include "tests/pipeline/render/stars/star_scene.h"
#include "tests/sanitized.h"

namespace domefall {
namespace {

SceneStar star_of(const SkyDirection& direction, double v, double temperature) {
  return {direction, v, std::pow(10, -0.4 * v) * bolometric_flux_at_v_zero(temperature),
          temperature, 1e-9};
}

struct Case {
  Region region;
  Tetrad tetrad;
  double r;
  Celerity<ReferenceTetrad> celerity;
};

const Celerity<ReferenceTetrad> kAtRest(0, 0, 0), kBrisk(0.2, 0.6, 0.3), kFast(-3, 8, 5);

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const double r : {1e8, 1e4, 300.0, 12.0, 6.0, 3.0, 2.5, 2.000001})
    for (const auto& c : {kAtRest, kBrisk, kFast}) all.push_back({Region::kI, Tetrad::kRain, r, c});
  for (const double r : {1.999999, 1.9, 1.0, 0.1, 1e-3, 1e-6})
    for (const auto& c : {kAtRest, kBrisk}) all.push_back({Region::kII, Tetrad::kRain, r, c});
  for (const auto& c :
       {Celerity<ReferenceTetrad>(1e4, 0, 0), Celerity<ReferenceTetrad>(-7e3, 5e3, 5e3)})
    for (const double r : {1e3, 4.0}) all.push_back({Region::kI, Tetrad::kRain, r, c});
  for (const double r : {2.001, 8.0}) {
    all.push_back({Region::kI, Tetrad::kOutgoing, r, kBrisk});
    all.push_back({Region::kIII, Tetrad::kRainOfThree, r, kBrisk});
    // At rest the observer moves outward against rain as fast as rain falls inward.
    const double s = std::sqrt(2 / r);
    all.push_back({Region::kI, Tetrad::kRain, r, {s / std::sqrt(1 - s * s), 0, 0}});
  }
  all.push_back({Region::kI, Tetrad::kRain, kFlatSpace, kFast});
  return all;
}

bool is_in_frame(const Projection& projection, const PointSpread& widths, const StarImage& image) {
  CapBlob blob{};
  blob.x = image.x, blob.y = image.y;
  blob.sigma = static_cast<float>(widths.sigma_of(image));
  std::copy_n(image.rgb, 3, blob.rgb);
  return place_cap(projection, blob);
}

// An image, computed by the paper's formulas alone.
struct Expected {
  StarImage image;
  double peak;
};
// All images of 24 orders that are bright enough and reach into the frame.
std::vector<Expected> expected(const StarScene& scene, const SkyTable* table,
                               const SceneStar& star) {
  const ObserverState& o = scene.state.observer;
  const Projection& projection = scene.state.projection;
  const double scale = scene.exposure();
  const PointSpread widths = scene.point_spread();
  const V3d source = apply_transposed(o.sky_from_tetrad, star.direction.v);
  std::vector<Expected> all;
  for (int order = 0; order < (table ? 24 : 1); ++order) {
    const SkyImage at = image_of(table, source, order, star.angular_radius);
    const AberratedLight seen = to_observer(o.celerity, at.direction.v);
    const double d = seen.frequency_ratio, g = at.frequency_ratio * d;
    const double flux = star.flux * at.amplification / (d * d) * g * g * g * g;
    const WorkingRgb c = blackbody_colours().per_flux(star.temperature * g);
    const auto pixel =
        pixel_of(projection, {apply_transposed(o.tetrad_from_camera, seen.direction)});
    if (!pixel) continue;
    Expected e{
        .image = {static_cast<float>(pixel->i - 1),
                  static_cast<float>(pixel->j - 1),
                  {static_cast<float>(c.r * flux * scale), static_cast<float>(c.g * flux * scale),
                   static_cast<float>(c.b * flux * scale)}},
        .peak =
            luminance(c) * flux * scale / (2 * std::numbers::pi * widths.least() * widths.least())};
    if (e.peak > kFaintestPeak && is_in_frame(projection, widths, e.image)) all.push_back(e);
  }
  return all;
}

double apart(const StarImage& a, const StarImage& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y);
}

// Expects that each image is found at its place and with its light, and that any others are too
// faint or beside the frame.
void compare(const StarScene& scene, bool far, const SceneStar& star) {
  std::vector<StarImage> found = all_images(scene.images(far), SceneStars({star}));
  const Projection& projection = scene.state.projection;
  for (const Expected& e : expected(scene, scene.table(far), SceneStars({star})[0])) {
    const auto nearest =
        std::min_element(found.begin(), found.end(), [&](const StarImage& a, const StarImage& b) {
          const auto off = [&](const StarImage& c) {
            return apart(c, e.image) + std::abs(std::log(light(c) / light(e.image)));
          };
          return off(a) < off(b);
        });
    if (nearest == found.end()) {
      EXPECT_LT(e.peak, 1.002 * kFaintestPeak) << "lost";
      continue;
    }
    EXPECT_LT(apart(*nearest, e.image), 0.012) << "order by order";
    EXPECT_NEAR(light(*nearest) / light(e.image), 1, 1e-3);
    found.erase(nearest);
  }
  const PointSpread widths = scene.point_spread();
  for (const StarImage& extra : found) {
    const double peak = light(extra) / (2 * std::numbers::pi * widths.least() * widths.least());
    EXPECT_TRUE(peak < 1.002 * kFaintestPeak || !is_in_frame(projection, widths, extra)) << peak;
  }
}

TEST(StarImageFinder, InBatchesAreThoseOfTheFormulasAndNoneIsLost) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> magnitude(-3, 14), temperature(2500, 30000);
  std::uniform_real_distribution<double> decades(-5, 0.4);
  // The blobs of the smallest dome reach over the rim farther than angle_over_sine() holds.
  const std::vector<Projection> projections{Domemaster{1024}, Domemaster{64},
                                            Stereographic{960, 540, 1.2}};
  for (const Case& c : cases())
    for (const Projection& projection : projections) {
      const StarScene scene({c.region, c.tetrad, c.r, c.celerity}, projection, 2);
      for (const bool far : {false, true}) {
        if (far && !scene.has(true)) continue;
        SCOPED_TRACE("r " + std::to_string(c.r) + " celerity " +
                     std::to_string(c.celerity.length()) + " tetrad " + tetrad_name(c.tetrad) +
                     (far ? " far" : " home"));
        for (int k = 0; k < tries(60, 12); ++k) {
          V3d source = random_direction(random);
          if (k % 3 == 0) {  // about the axis
            const double angle = std::pow(10, decades(random));
            source = V3d((k % 2 ? -1 : 1) * std::cos(angle), std::sin(angle) * std::cos(k),
                         std::sin(angle) * std::sin(k));
          }
          if (std::hypot(source.y, source.z) < 1.01 * kNearAxis * scene.show.least_star_radius)
            continue;
          compare(scene, far, star_of(scene.sky(source), magnitude(random), temperature(random)));
          if (testing::Test::HasFailure()) return;
        }
      }
    }
}

// The images of a star, found in batches or one by one, stand where rays come from it.
TEST(StarImageFinder, PutsStarsOfBothSkiesOfAWormholeWhereTheSkiesAre) {
  std::mt19937 random(8);
  for (const double l : {3.0, -3.0}) {
    const Show show = show_in_wormhole(l, Domemaster{512});
    FrameState state = frame_state(show, 0);
    for (const SkyRegion sky : {SkyRegion::kI, SkyRegion::kIII})
      state.settings.sky[sky].max_magnitude = 99;
    const FrameScene scene = scene_with(show, state);
    for (const SkyRegion sky : {SkyRegion::kI, SkyRegion::kIII}) {
      const StarImageFinder finder(scene, sky);
      int images = 0;
      for (int k = 0; k < 20; ++k) {
        const SceneStar star = star_of({random_direction(random)}, 1, 6000);
        std::vector<StarImage> found = all_images(finder, SceneStars({star}));
        finder.append(star, found);
        for (const StarImage& image : found) {
          const PixelPosition pixel{image.x + 1.0, image.y + 1.0};
          const ViewRay ray = scene.tracer.trace(direction_at(show.projection, pixel));
          if (!(ray.longer() < 20)) continue;
          ++images;
          EXPECT_EQ(ray.sky, sky);
          EXPECT_LT((ray.sky_direction - star.direction.v).length(), 1e-3 * (1 + ray.longer()));
        }
      }
      EXPECT_GT(images, 15) << l;
    }
  }
}

// A list of stars has the images of its stars, down to the limit of magnitude.
TEST(StarImageFinder, OfManyStarsAreThoseOfEach) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> magnitude(-1, 12), temperature(2500, 30000);
  StarScene scene({Region::kI, Tetrad::kRain, 9, kBrisk}, Domemaster{512});
  scene.state.settings.sky[SkyRegion::kI].max_magnitude = 10;
  for (const bool soft : {false, true}) {
    scene.state.settings.sky[SkyRegion::kI].soft_limit = soft;
    std::vector<SceneStar> stars;
    for (int k = 0; k < 1500; ++k)
      stars.push_back(star_of({random_direction(random)}, magnitude(random), temperature(random)));
    const StarImageFinder maker = scene.images();
    std::vector<StarImage> each, all = all_images(maker, SceneStars(stars));
    for (const SceneStar& star : stars)
      for (const StarImage& image : all_images(maker, SceneStars({star}))) each.push_back(image);
    const auto before = [](const StarImage& a, const StarImage& b) {
      return std::tie(a.x, a.y, a.rgb[0]) < std::tie(b.x, b.y, b.rgb[0]);
    };
    std::sort(each.begin(), each.end(), before);
    std::sort(all.begin(), all.end(), before);
    ASSERT_GT(all.size(), 1000u);
    ASSERT_EQ(all.size(), each.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      ASSERT_EQ(all[k].x, each[k].x);
      ASSERT_EQ(all[k].rgb[1], each[k].rgb[1]);
    }
    // One star at a time gives these images and some beside the frame.
    std::vector<StarImage> exact;
    for (const SceneStar& star : stars) maker.append(star, exact);
    EXPECT_GE(exact.size(), all.size());
    EXPECT_LT(scene.images().count(SceneStars(stars)), 1400u);
  }
}

// What the light of a star at no redshift says of its V.
TEST(StarImageFinder, AtNoRedshiftHaveTheirMagnitude) {
  const StarScene scene({Region::kI, Tetrad::kRain, kFlatSpace, kAtRest}, Domemaster{1024}, 8);
  const V3d ahead = apply(scene.state.observer.tetrad_from_camera, V3d(0.3, 0.2, 0.9));
  for (double t = 3000; t <= 30000; t *= 1.07)
    for (const float v : {-1.46f, 5.0f, 11.3f}) {
      const SceneStars stars(std::vector<Star>{{scene.sky(ahead), v, static_cast<float>(t)}});
      const auto images = all_images(scene.images(), stars);
      ASSERT_EQ(images.size(), 1u);
      const Xyz per_radiance = blackbody_xyz(t);
      const double flux =
          light(images[0]) / scene.exposure() * blackbody_radiance(t) / per_radiance.y;
      EXPECT_NEAR(-2.5 * std::log10(flux / bolometric_flux_at_v_zero(t)), v, 0.005) << t;
    }
}

// A star is drawn if its magnitude is exactly the limit, though one is a float and the other a
// double.
TEST(SceneStars, AreTakenUpToTheLimitItself) {
  for (const double v : {8.3, 6.5, 0.1, -1.44, 12.123}) {
    const SceneStars stars({SceneStar{{V3d(0, 0, 1)}, v, 1e-12, 6000, 1e-9}});
    EXPECT_EQ(stars.count_to_magnitude(v), 1u) << v;
    EXPECT_EQ(stars.count_to_magnitude(v - 1e-3), 0u) << v;
  }
}

TEST(BlackbodyTable, HasTheColoursOfBlackbodies) {
  for (double t = 1000; t < 1e10; t *= 1.0013) {
    const BlackbodyTable::Light seen = blackbody_table()(t);
    const WorkingRgb wanted = blackbody_colours().per_flux(t);
    EXPECT_NEAR(seen.luminance / luminance(wanted), 1, t < 3000 ? 5e-4 : 1e-4) << t;
    EXPECT_NEAR(seen.b, wanted.b, 1e-4 * std::max(wanted.r, wanted.b)) << t;
    EXPECT_LE(luminance(wanted), blackbody_table().most_luminance());
  }
  EXPECT_EQ(blackbody_table()(10).luminance, 0);
  EXPECT_EQ(blackbody_table()(0).r, 0);
}

}  // namespace
}  // namespace domefall
