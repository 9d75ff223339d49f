#include "pipeline/render/sky/sky_sampler.h"

#include <gtest/gtest.h>

#include <bit>

#include "pipeline/colour/blackbody.h"
#include "pipeline/simd/half_row.h"
#include "pipeline/sky/make/panorama.h"
#include "tests/pipeline/render/scenes.h"

namespace domefall {
namespace {

FloatImage noise(int width) {
  FloatImage image(width, width / 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(0.2f, 1.0f);
  for (float& value : image.pixels) value = u(random);
  return image;
}

FootprintBatch random_places(std::mt19937& random, double unit) {
  std::uniform_real_distribution<double> octave(-14, 1);
  FootprintBatch places{};
  for (std::size_t k = 0; k < FootprintBatch::kSize; ++k) {
    const V3d d = random_direction(random);
    places.x[k] = static_cast<float>(d.x), places.y[k] = static_cast<float>(d.y);
    places.z[k] = static_cast<float>(d.z);
    places.gain[k] = static_cast<float>(unit);
    places.wide[k] = places.narrow[k] = static_cast<float>(std::exp2(octave(random)));
    const V3d along = d.cross(random_direction(random)).normalized() * places.wide[k];
    places.ax[k] = static_cast<float>(along.x), places.ay[k] = static_cast<float>(along.y);
    places.az[k] = static_cast<float>(along.z);
  }
  return places;
}

void sample_all(const SkySampler& sampler, const FootprintBatch& places, SampleKind kind,
                float* rgb) {
  std::array<SampleKind, FootprintBatch::kSize> kinds;
  kinds.fill(kind);
  sampler.sample(places, FootprintBatch::kSize, kinds.data(), rgb);
}

TEST(SkySampler, SeesWhatOneLookAtTheMapSees) {
  const SkyMap map = map_of_panorama(noise(512));
  const SkySampler sampler(map);
  std::mt19937 random(1);
  std::array<float, 3 * FootprintBatch::kSize + 1> rgb;
  for (int round = 0; round < 20; ++round) {
    const FootprintBatch places = random_places(random, map.unit());
    for (const bool minified : {true, false}) {
      if (minified)
        sample_all(sampler, places, SampleKind(1, true), rgb.data());
      else
        sampler.sample_plain(places, FootprintBatch::kSize, rgb.data());
      for (std::size_t k = 0; k < FootprintBatch::kSize; ++k) {
        const V3d d(places.x[k], places.y[k], places.z[k]);
        const WorkingRgb c = map.sample(d, minified ? places.wide[k] : 0);
        // A place in floats is off by 1e-4 of a texel; noise changes by all of itself from one to the next.
        ASSERT_NEAR(rgb[3 * k + 1], c.g, 1e-3 * c.g) << d << " " << places.wide[k];
        ASSERT_NEAR(rgb[3 * k + 2], c.b, 1e-3 * c.b);
      }
    }
  }
}

// A line of looks is the mean of as many looks; between the levels, on the average over many.
TEST(SkySampler, ALineOfLooksIsTheMeanOfItsLooks) {
  const SkyMap map = map_of_panorama(noise(512));
  const SkySampler sampler(map);
  std::mt19937 random(2);
  std::array<float, 3 * FootprintBatch::kSize + 1> rgb;
  for (const int taps : {2, 4, 8, 32}) {
    FootprintBatch places = random_places(random, map.unit());
    for (float& narrow : places.narrow) narrow *= 0.01f;
    sample_all(sampler, places, SampleKind(taps, true), rgb.data());
    double worst = 0;
    for (std::size_t k = 0; k < FootprintBatch::kSize; ++k) {
      double sum = 0;
      for (int tap = 0; tap < taps; ++tap) {
        const double t = (tap + 0.5) / taps - 0.5;
        const V3d d(places.x[k] + t * places.ax[k], places.y[k] + t * places.ay[k],
                    places.z[k] + t * places.az[k]);
        sum += map.sample(d, places.wide[k] / (1.5f * static_cast<float>(taps))).g /
               static_cast<float>(taps);
      }
      worst = std::max(worst, std::abs(rgb[3 * k + 1] / sum - 1));
    }
    EXPECT_LT(worst, taps < 4 ? 1e-3 : 0.12) << taps;
  }
}

SampleKind kind_of(const SkySampler& sampler, double wide, double narrow,
                   int most = SkySampler::kMostTaps, float longest = 10) {
  const auto w = static_cast<float>(wide), n = static_cast<float>(narrow);
  SampleKind kind;
  sampler.choose_kinds(&w, &n, 1, most, longest, &kind);
  return kind;
}

TEST(SkySampler, TakesSoManyLooksThatTheyStandNoFartherApartThanTheyReach) {
  const SkyMap map = map_of_panorama(noise(512));  // texels of pi/2/256
  const SkySampler sampler(map);
  const double texel = 1.5708 / 256;
  EXPECT_EQ(kind_of(sampler, 0.9 * texel, texel / 100), SampleKind(1, false));
  EXPECT_EQ(kind_of(sampler, 1.1 * texel, texel / 100), SampleKind(1, true));
  EXPECT_EQ(kind_of(sampler, 2.9 * texel, texel / 100), SampleKind(2, false));
  EXPECT_EQ(kind_of(sampler, 5.9 * texel, texel / 100), SampleKind(4, false));
  EXPECT_EQ(kind_of(sampler, 44 * texel, 10 * texel), SampleKind(4, true));
  EXPECT_EQ(kind_of(sampler, 300 * texel, 300 * texel), SampleKind(1, true));
  EXPECT_EQ(kind_of(sampler, 1, 1e-9), SampleKind(SkySampler::kMostTaps, true));
  EXPECT_EQ(kind_of(sampler, 1, 1e-9, 4), SampleKind(4, true));
  EXPECT_EQ(kind_of(sampler, 1, 1e-9, 32, 0.7f), SampleKind(1, true));
}

// Places looked at as they need, and some that are nobody's: as all of them looked at in each way.
TEST(SkySampler, LooksOfManyKindsAreThoseOfEachKind) {
  const SkyMap map = map_of_panorama(noise(512));
  const SkySampler sampler(map);
  std::mt19937 random(6);
  FootprintBatch places = random_places(random, map.unit());
  std::uniform_real_distribution<float> octaves(-6, 0);
  for (float& narrow : places.narrow) narrow *= std::exp2(octaves(random));
  std::array<SampleKind, FootprintBatch::kSize> kinds;
  sampler.choose_kinds(places.wide.data(), places.narrow.data(), FootprintBatch::kSize,
                       SkySampler::kMostTaps, 0.7f, kinds.data());
  for (std::size_t k = 0; k < FootprintBatch::kSize; k += 7) kinds[k] = SampleKind();
  std::array<float, 3 * FootprintBatch::kSize + 1> rgb, one;
  rgb.fill(-1);
  sampler.sample(places, FootprintBatch::kSize, kinds.data(), rgb.data());
  std::size_t looked = 0;
  for (int code = 2; code < 2 * SkySampler::kMostTaps + 2; ++code) {
    const SampleKind kind(code / 2, code % 2 != 0);
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) continue;
    sample_all(sampler, places, kind, one.data());
    for (std::size_t k = 0; k < FootprintBatch::kSize; ++k)
      for (std::size_t c = 3 * k; kinds[k] == kind && c < 3 * k + 3; ++c, ++looked)
        ASSERT_EQ(rgb[c], one[c]) << code;
  }
  for (std::size_t k = 0; k < FootprintBatch::kSize; k += 7, looked += 3)
    ASSERT_EQ(rgb[3 * k + 1], -1);
  EXPECT_EQ(looked, 3 * FootprintBatch::kSize);
}

// Blackbody light, shifted: what a look at the map and the exact colours give.
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
  std::array<float, 3 * FootprintBatch::kSize + 1> rgb;
  for (const double g : {0.005, 0.02, 0.3, 1.0, 5.0, 1e3, 1e6}) {
    FootprintBatch places = random_places(random, unit * g * g * g * g);
    places.tone.fill(static_cast<float>(std::log2(g)));
    sample_all(sampler, places, SampleKind(1, true), rgb.data());
    const WorkingRgb c = blackbody_colours().per_flux(t * g);
    const double light = 32 * unit * g * g * g * g;
    ASSERT_NEAR(rgb[300], c.r * light, 2e-3 * c.r * light) << g;
    ASSERT_NEAR(rgb[302], c.b * light, 4e-3 * c.b * light) << g;
  }
}

TEST(HalfRow, RoundsAsHalfFloatsDo) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::uint32_t> bits(0, 0x477fe000);  // 0 to 65504
  std::vector<float> values{
      0, 1e-9f, 0x1p-24f, 0x1p-25f, 0x1.8p-24f, 0x1p-14f, 0.99999f * 0x1p-14f, 65504, 65519, 1e30f};
  while (values.size() < 100000) values.push_back(std::bit_cast<float>(bits(random)));
  std::vector<std::uint16_t> out(values.size());
  ASSERT_TRUE(to_half(values.data(), static_cast<int>(values.size()), out.data()));
  for (std::size_t k = 0; k < values.size(); ++k)
    ASSERT_EQ(out[k], Imath::half(std::min(values[k], 65504.0f)).bits()) << values[k];
}

TEST(HalfRow, TellsWhatIsNotFinite) {
  std::uint16_t out[64];
  for (const float bad : {NAN, INFINITY, -INFINITY})
    for (int at : {0, 17, 63}) {
      std::vector<float> values(64, 1.0f);
      values[static_cast<std::size_t>(at)] = bad;
      EXPECT_FALSE(to_half(values.data(), 64, out));
    }
}

}  // namespace
}  // namespace domefall
