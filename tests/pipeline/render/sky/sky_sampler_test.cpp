#include "pipeline/render/sky/sky_sampler.h"

#include <gtest/gtest.h>

#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/sky/panorama.h"
#include "pipeline/sources/sky/sky_pyramid.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

FloatImage noise_image(int width) {
  FloatImage image(width, width / 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(0.2f, 1.0f);
  for (float& value : image.pixels) value = u(random);
  return image;
}

SampleBatch random_batch(std::mt19937& random, double unit) {
  std::uniform_real_distribution<double> octave(-14, 1);
  SampleBatch batch{};
  for (std::size_t k = 0; k < SampleBatch::kSize; ++k) {
    const V3d d = random_direction(random);
    batch.x[k] = static_cast<float>(d.x), batch.y[k] = static_cast<float>(d.y);
    batch.z[k] = static_cast<float>(d.z);
    batch.gain[k] = static_cast<float>(unit);
    batch.wide[k] = batch.narrow[k] = static_cast<float>(std::exp2(octave(random)));
    const V3d along = d.cross(random_direction(random)).normalized() * batch.wide[k];
    batch.ax[k] = static_cast<float>(along.x), batch.ay[k] = static_cast<float>(along.y);
    batch.az[k] = static_cast<float>(along.z);
  }
  return batch;
}

void sample_all(const SkySampler& sampler, const SampleBatch& batch, SampleFilter filter,
                float* rgb) {
  std::array<SampleFilter, SampleBatch::kSize> filters;
  filters.fill(filter);
  sampler.sample(batch, SampleBatch::kSize, filters.data(), rgb);
}

TEST(SkySampler, TakesTheSampleThatTheMapTakes) {
  const SkyMap map = map_of_panorama(noise_image(512));
  const SkySampler sampler(map);
  std::mt19937 random(1);
  std::array<float, 3 * SampleBatch::kSize + 1> rgb;
  for (int round = 0; round < 20; ++round) {
    const SampleBatch batch = random_batch(random, map.unit());
    for (const bool minified : {true, false}) {
      if (minified)
        sample_all(sampler, batch, SampleFilter(1, true), rgb.data());
      else
        sampler.sample_plain(batch, SampleBatch::kSize, rgb.data());
      for (std::size_t k = 0; k < SampleBatch::kSize; ++k) {
        const V3d d(batch.x[k], batch.y[k], batch.z[k]);
        const WorkingRgb c = map.sample(d, minified ? batch.wide[k] : 0);
        // A direction in floats errs by 1e-4 of a texel, and noise changes entirely from one to the
        // next.
        ASSERT_NEAR(rgb[3 * k + 1], c.g, 1e-3 * c.g) << d << " " << batch.wide[k];
        ASSERT_NEAR(rgb[3 * k + 2], c.b, 1e-3 * c.b);
      }
    }
  }
}

// Where faces meet, one of the four texels is a neighbour's.  Halves are exact in floats, so that
// sampler and map choose the same face.  The number of directions is odd.
TEST(SkySampler, TakesTheSampleThatTheMapTakesAtEdgesAndCornersOfTheCube) {
  const SkyMap map = map_of_panorama(noise_image(512));
  SampleBatch batch{};
  int count = 0;
  for (int code = 1; code < 124; ++code) {  // 62 is no direction
    const auto part = [code](int place) { return static_cast<float>(code / place % 5 - 2) / 2; };
    if (code == 62) continue;
    batch.x[count] = part(1), batch.y[count] = part(5), batch.z[count] = part(25);
    batch.gain[count++] = static_cast<float>(map.unit());
  }
  batch.x[count] = 1, batch.gain[count++] = static_cast<float>(map.unit());
  ASSERT_EQ(count % 2, 1);
  std::array<float, 3 * SampleBatch::kSize> rgb;
  rgb.fill(-1);
  SkySampler(map).sample_plain(batch, count, rgb.data());
  for (int k = 0; k < count; ++k) {
    const WorkingRgb c = map.sample(V3d(batch.x[k], batch.y[k], batch.z[k]), 0);
    ASSERT_NEAR(rgb[3 * k], c.r, 1e-5 * c.r) << k;
    ASSERT_NEAR(rgb[3 * k + 2], c.b, 1e-5 * c.b) << k;
  }
  EXPECT_EQ(rgb[3 * count + 1], -1) << "at most one value is written behind the last sample";
}

// From four taps on, each is taken on one level instead of on two, so that their mean is only right
// on average.
TEST(SkySampler, ALineOfTapsIsTheMeanOfItsTaps) {
  const SkyMap map = map_of_panorama(noise_image(512));
  const SkySampler sampler(map);
  std::mt19937 random(2);
  std::array<float, 3 * SampleBatch::kSize + 1> rgb;
  for (const int taps : {2, 4, 8, 32}) {
    SampleBatch batch = random_batch(random, map.unit());
    for (float& narrow : batch.narrow) narrow *= 0.01f;
    sample_all(sampler, batch, SampleFilter(taps, true), rgb.data());
    double worst = 0;
    for (std::size_t k = 0; k < SampleBatch::kSize; ++k) {
      double sum = 0;
      for (int tap = 0; tap < taps; ++tap) {
        const double t = (tap + 0.5) / taps - 0.5;
        const V3d d(batch.x[k] + t * batch.ax[k], batch.y[k] + t * batch.ay[k],
                    batch.z[k] + t * batch.az[k]);
        sum += map.sample(d, batch.wide[k] / (1.5f * static_cast<float>(taps))).g /
               static_cast<float>(taps);
      }
      worst = std::max(worst, std::abs(rgb[3 * k + 1] / sum - 1));
    }
    EXPECT_LT(worst, taps < 4 ? 1e-3 : 0.12) << taps;
  }
}

SampleFilter filter_of(const SkySampler& sampler, double wide, double narrow,
                       int most_taps = SkySampler::kMostTaps, float longest_line = 10) {
  const auto w = static_cast<float>(wide), n = static_cast<float>(narrow);
  SampleFilter filter;
  sampler.choose_filters(&w, &n, 1, most_taps, longest_line, &filter);
  return filter;
}

TEST(SkySampler, TakesSoManyTapsThatTheyStandNoFartherApartThanTheyReach) {
  const SkyMap map = map_of_panorama(noise_image(512));  // texels of pi/2/256
  const SkySampler sampler(map);
  const double texel = 1.5708 / 256;
  EXPECT_EQ(filter_of(sampler, 0.9 * texel, texel / 100), SampleFilter(1, false));
  EXPECT_EQ(filter_of(sampler, 1.1 * texel, texel / 100), SampleFilter(1, true));
  EXPECT_EQ(filter_of(sampler, 2.9 * texel, texel / 100), SampleFilter(2, false));
  EXPECT_EQ(filter_of(sampler, 5.9 * texel, texel / 100), SampleFilter(4, false));
  EXPECT_EQ(filter_of(sampler, 44 * texel, 10 * texel), SampleFilter(4, true));
  EXPECT_EQ(filter_of(sampler, 300 * texel, 300 * texel), SampleFilter(1, true));
  EXPECT_EQ(filter_of(sampler, 1, 1e-9), SampleFilter(SkySampler::kMostTaps, true));
  EXPECT_EQ(filter_of(sampler, 1, 1e-9, 4), SampleFilter(4, true));
  EXPECT_EQ(filter_of(sampler, 1, 1e-9, 32, 0.7f), SampleFilter(1, true));
}

// Samples with the filters that they need, and some without taps, against all samples with each
// filter.
TEST(SkySampler, SamplesOfManyFiltersAreThoseOfEachFilter) {
  const SkyMap map = map_of_panorama(noise_image(512));
  const SkySampler sampler(map);
  std::mt19937 random(6);
  SampleBatch batch = random_batch(random, map.unit());
  std::uniform_real_distribution<float> octaves(-6, 0);
  for (float& narrow : batch.narrow) narrow *= std::exp2(octaves(random));
  std::array<SampleFilter, SampleBatch::kSize> filters;
  sampler.choose_filters(batch.wide.data(), batch.narrow.data(), SampleBatch::kSize,
                         SkySampler::kMostTaps, 0.7f, filters.data());
  for (std::size_t k = 0; k < SampleBatch::kSize; k += 7) filters[k] = SampleFilter();
  std::array<float, 3 * SampleBatch::kSize + 1> rgb, one;
  rgb.fill(-1);
  sampler.sample(batch, SampleBatch::kSize, filters.data(), rgb.data());
  std::size_t compared = 0;
  for (int code = 2; code < 2 * SkySampler::kMostTaps + 2; ++code) {
    const SampleFilter filter(code / 2, code % 2 != 0);
    if (std::find(filters.begin(), filters.end(), filter) == filters.end()) continue;
    sample_all(sampler, batch, filter, one.data());
    for (std::size_t k = 0; k < SampleBatch::kSize; ++k)
      for (std::size_t c = 3 * k; filters[k] == filter && c < 3 * k + 3; ++c, ++compared)
        ASSERT_EQ(rgb[c], one[c]) << code;
  }
  for (std::size_t k = 0; k < SampleBatch::kSize; k += 7, compared += 3)
    ASSERT_EQ(rgb[3 * k + 1], -1);
  EXPECT_EQ(compared, 3 * SampleBatch::kSize);
}

// What has less luminance than the black level is black, and the rest keeps its hue.
TEST(SkySampler, TakesTheBlackLevelFromTheLuminanceAndKeepsTheHue) {
  const SkyMap map = map_of_panorama(noise_image(512));
  const double black = map.sample({1, 0, 0}, 2).g / map.unit();
  const SkySampler all(map), above(map, black);
  std::mt19937 random(5);
  std::array<float, 3 * SampleBatch::kSize + 1> with{}, without{};
  int dark = 0;
  for (const int taps : {0, 1, 4}) {  // 0 stands for the plain loop
    const SampleBatch batch = random_batch(random, map.unit());
    const auto sample = [&](const SkySampler& sampler, float* rgb) {
      if (taps == 0) return sampler.sample_plain(batch, SampleBatch::kSize, rgb);
      sample_all(sampler, batch, SampleFilter(taps, true), rgb);
    };
    sample(all, without.data());
    sample(above, with.data());
    for (std::size_t k = 0; k < SampleBatch::kSize; ++k) {
      const float* c = &without[3 * k];
      const double kept = std::max(0.0, 1 - black * map.unit() / luminance({c[0], c[1], c[2]}));
      dark += kept == 0;
      for (std::size_t i = 3 * k; i < 3 * k + 3; ++i)
        ASSERT_NEAR(with[i], kept * without[i], 1e-6 * without[i]) << taps;
    }
  }
  EXPECT_GT(dark, 10) << "some samples lie below the level";
}

// A thermal sample that has a part of the light left keeps its temperature.
TEST(SkySampler, TakesTheBlackLevelFromTheRadianceOfAThermalMap) {
  const double radiance = 2e-5, theta = 4;
  const SkyPyramid pyramid(SkyMapKind::kThermal, sky_unit(radiance * theta), 8);
  paint(pyramid.levels[0], [&](const V3d&, float* channel) {
    channel[0] = static_cast<float>(radiance / pyramid.unit);
    channel[1] = static_cast<float>(radiance * theta / pyramid.unit);
  });
  pyramid.finish();
  const SkyMap map = pyramid.map();
  std::mt19937 random(7);
  const SampleBatch batch = random_batch(random, map.unit());
  std::array<float, 3 * SampleBatch::kSize + 1> all, quarter, none;
  sample_all(SkySampler(map), batch, SampleFilter(1, true), all.data());
  sample_all(SkySampler(map, 0.75 * radiance / map.unit()), batch, SampleFilter(1, true),
             quarter.data());
  sample_all(SkySampler(map, 2 * radiance / map.unit()), batch, SampleFilter(1, true), none.data());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(quarter[k], all[k] / 4, 0.005 * all[k]);  // half floats hold the radiance to 0.1 %
    EXPECT_EQ(none[k], 0);
  }
}

// The oracle is one sample of the map and the exact colour of its temperature.
TEST(SkySampler, ShiftsThermalLightByItsTemperature) {
  SkyTexel texel{};
  texel.channel[0] = 0x5000;  // 32
  texel.channel[1] = 0x5c40;  // 272: theta = 8.5
  std::vector<std::vector<SkyTexel>> memory;
  std::vector<SkyLevel> levels;
  for (int size = 8; size >= 1; size /= 2) {
    memory.emplace_back(6 * SkyLevel::face_texels(size), texel);
    levels.push_back({size, memory.back().data()});
  }
  const double unit = 1e-9, t = kThermalBase * std::exp2(8.5);
  const SkyMap map(SkyMapKind::kThermal, unit, levels, nullptr);
  const SkySampler sampler(map);
  std::mt19937 random(4);
  std::array<float, 3 * SampleBatch::kSize + 1> rgb;
  for (const double g : {0.005, 0.02, 0.3, 1.0, 5.0, 1e3, 1e6}) {
    SampleBatch batch = random_batch(random, unit * g * g * g * g);
    batch.tone.fill(static_cast<float>(std::log2(g)));
    sample_all(sampler, batch, SampleFilter(1, true), rgb.data());
    const WorkingRgb c = blackbody_colours().per_flux(t * g);
    const double light = 32 * unit * g * g * g * g;
    ASSERT_NEAR(rgb[300], c.r * light, 2e-3 * c.r * light) << g;
    ASSERT_NEAR(rgb[302], c.b * light, 4e-3 * c.b * light) << g;
  }
}

}  // namespace
}  // namespace domefall
