#include "pipeline/render/sky/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/render/sky/tap_queue.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

constexpr int kSamples = SampleBatch::kSize;
// A footprint counts as round, and has one tap, if its length is at most this many times its width
// or a texel's.
constexpr float kRound = 1.25f;
// The taps of a line are at most this many of their widths apart.
constexpr float kSpacing = 1.5f;
constexpr std::array<int, 9> kTaps{1, 2, 4, 6, 8, 12, 16, 24, SkySampler::kMostTaps};
// Texels are prefetched this many plain samples before they are read.
constexpr int kPrefetchedSamples = 80;

// FinestTaps says where plain samples fall on the finest level.
struct FinestTaps {
  alignas(64) std::array<std::int32_t, kSamples> texel;
  alignas(64) std::array<TexelWeights, kSamples> weights;
};

[[gnu::always_inline]] inline void locate_plain_loop(const SampleBatch& batch, int count, int size,
                                                     FinestTaps& taps) {
  const float half_size = static_cast<float>(size) / 2;
  for (int k = 0; k < count; ++k) {
    const FloatFacePoint point = float_face_of(batch.x[k], batch.y[k], batch.z[k]);
    float fx, fy;
    locate_texels(point, half_size, size + 2, taps.texel[k], fx, fy);
    weigh_texels(fx, fy, 1, taps.weights[k]);
  }
}
Dispatched<locate_plain_loop> locate_plain;

// A MapDevelopment says how the light of a colour map becomes pixel values.
struct MapDevelopment {
  std::array<float, 3> luminance;  // the weights of the channels
  float black;                     // the luminance that becomes 0
  const float* gain;               // of each sample
};

// Lowers the luminance of samples by the black level, but not below 0, and keeps their hue.  A
// sample without light makes `kept` -infinity or NaN, for which the factor is 0, too.
[[gnu::always_inline]] inline void develop(const MapDevelopment& how, int count, float* rgb) {
  const float red = how.luminance[0], green = how.luminance[1], blue = how.luminance[2],
              black = how.black;
  const float* gain = how.gain;
  for (int k = 0; k < count; ++k) {
    const float r = rgb[3 * k], g = rgb[3 * k + 1], b = rgb[3 * k + 2];
    const float kept = 1 - black / (r * red + g * green + b * blue);
    const float factor = kept > 0 ? kept * gain[k] : 0;
    rgb[3 * k] = r * factor;
    rgb[3 * k + 1] = g * factor;
    rgb[3 * k + 2] = b * factor;
  }
}

// Writes the sum of a sample.  The fourth channel is 0 and is overwritten by the next sample.
[[gnu::always_inline]] inline void write_total(const ChannelPair& sides, float* rgb) {
  Channels light;
  total(sides, light);
  std::memcpy(rgb, &light, sizeof light);
}

// Takes plain samples in a loop of their own, because they are most samples of most frames.
template <bool kWide>
[[gnu::always_inline]] inline void take_plain_loop(const SkyLevel& level, const FinestTaps& taps,
                                                   const MapDevelopment& how, int count,
                                                   float* rgb) {
  const SkyTexel* texels = level.texels;
  const int stride = level.size + 2;
  for (int k = 0; k < count; ++k) {
    prefetch_texels(texels + taps.texel[std::min(k + kPrefetchedSamples, count - 1)], stride);
    ChannelPair sides;
    take_texels<kWide>(texels + taps.texel[k], stride, taps.weights[k], sides);
    write_total(sides, rgb + 3 * k);
  }
  develop(how, count, rgb);
}
Dispatched<take_plain_loop<true>> take_plain;
Dispatched<take_plain_loop<false>> take_plain_by_halves;

[[gnu::always_inline]] inline void to_colours_loop(const ChannelPair* sums,
                                                   const MapDevelopment& how, int count,
                                                   float* rgb) {
  for (int k = 0; k < count; ++k) write_total(sums[k], rgb + 3 * k);
  develop(how, count, rgb);
}
Dispatched<to_colours_loop> to_colours;

// Turns sums of a thermal map into colours.  The first two channels are the radiance I and I theta
// (SkyMapKind::kThermal), so their ratio is the mean of theta.  The temperature is raised by `tone`
// octaves.
void thermal_to_colours(const ChannelPair* sums, float black, const float* gain, const float* tone,
                        int count, float* rgb) {
  static const auto base = static_cast<float>(std::log2(kThermalBase));
  const BlackbodyColours& colours = blackbody_colours();
  for (int k = 0; k < count; ++k, rgb += 3) {
    Channels sum;
    total(sums[k], sum);
    const float radiance = sum[0] - black;
    WorkingRgb colour{0, 0, 0};
    if (radiance > 0) colour = colours.per_flux_log2(base + sum[1] / sum[0] + tone[k]);
    const float scale = radiance * gain[k];
    rgb[0] = colour.r * scale;
    rgb[1] = colour.g * scale;
    rgb[2] = colour.b * scale;
  }
}

// TapLimits gives, for each number of taps, the longest footprint for which it is enough, in units
// of the footprint's width.
struct TapLimits {
  std::array<int, kTaps.size()> taps;
  std::array<float, kTaps.size()> longest;
};

// Chooses filters and writes their codes, as SampleFilter makes them.
[[gnu::always_inline]] inline void choose_texels_loop(const float* wide, const float* narrow,
                                                      int count, float texel,
                                                      const TapLimits& limits, float longest_line,
                                                      std::uint8_t* codes) {
  const TapLimits l = limits;
  for (int k = 0; k < count; ++k) {
    // No tap is narrower than a texel, so a narrower footprint counts as one texel wide.
    const float elongation = wide[k] / (narrow[k] > texel ? narrow[k] : texel);
    int wanted = 1;
    for (std::size_t j = 1; j < l.taps.size(); ++j)
      wanted = elongation > l.longest[j - 1] ? l.taps[j] : wanted;
    const int taps = wide[k] < longest_line ? wanted : 1;
    const float spaced = wide[k] / (static_cast<float>(taps) * kSpacing);
    const float tap_width = taps == 1 ? wide[k] : narrow[k] > spaced ? narrow[k] : spaced;
    // Taps wider than the finest texel need coarser levels.
    codes[k] = static_cast<std::uint8_t>(2 * taps + (tap_width > texel ? 1 : 0));
  }
}
Dispatched<choose_texels_loop> choose_texels;

constexpr std::array<std::uint16_t, kSamples + 1> kNumbers = [] {
  std::array<std::uint16_t, kSamples + 1> numbers{};
  for (int k = 0; k <= kSamples; ++k) numbers[k] = static_cast<std::uint16_t>(k);
  return numbers;
}();

// A SortedByFilter holds the indices of samples, sorted by their filters.
class SortedByFilter {
 public:
  SortedByFilter(const SampleFilter* filters, int count) {
    ends_.fill(0);
    each_run(filters, count, [](int& members, int first, int end) { members += end - first; });
    // Each count becomes the start of its filter's indices.  While indices are copied, the start
    // moves on to their end.
    for (int before = 0; int& end : ends_) {
      const int members = end;
      end = before;
      before += members;
    }
    each_run(filters, count, [this](int& to, int first, int end) {
      std::copy(&kNumbers[first], &kNumbers[end], &indices_[to]);
      to += end - first;
    });
  }

  const std::uint16_t* indices(SampleFilter filter) const {
    return &indices_[ends_[filter.code() - 1]];
  }
  int count(SampleFilter filter) const { return ends_[filter.code()] - ends_[filter.code() - 1]; }
  bool all_have_taps() const { return ends_[0] == 0; }

 private:
  // Calls f(ends_[code], first, end) for each run of samples with one filter.  Runs are mostly
  // long, since neighbours are alike.  Eight filters are therefore compared at a time.
  template <class F>
  void each_run(const SampleFilter* filters, int count, F&& f) {
    for (int first = 0, end = 0; first < count; first = end) {
      std::array<SampleFilter, 8> same, next;
      same.fill(filters[first]);
      for (; end + 8 <= count; end += 8) {
        std::copy_n(filters + end, 8, next.begin());
        if (next != same) break;
      }
      while (end < count && filters[end] == filters[first]) ++end;
      f(ends_[filters[first].code()], first, end);
    }
  }

  std::array<std::uint16_t, kSamples> indices_;
  std::array<int, 2 * SkySampler::kMostTaps + 2> ends_;  // in indices_, by the filter's code
};

[[gnu::always_inline]] inline void gather_points_loop(const SampleBatch& __restrict from,
                                                      const std::uint16_t* indices, int count,
                                                      SampleBatch& __restrict to) {
  for (int m = 0; m < count; ++m) {
    const int k = indices[m];
    to.x[m] = from.x[k];
    to.y[m] = from.y[k];
    to.z[m] = from.z[k];
    to.wide[m] = from.wide[k];
  }
}
Dispatched<gather_points_loop> gather_points;

[[gnu::always_inline]] inline void gather_lines_loop(const SampleBatch& __restrict from,
                                                     const std::uint16_t* indices, int count,
                                                     SampleBatch& __restrict to) {
  for (int m = 0; m < count; ++m) {
    const int k = indices[m];
    to.narrow[m] = from.narrow[k];
    to.ax[m] = from.ax[k];
    to.ay[m] = from.ay[k];
    to.az[m] = from.az[k];
  }
}
Dispatched<gather_lines_loop> gather_lines;

// Queues the taps of the first `count` samples of a batch, all of which have this filter.
void queue_taps(const SampleBatch& b, SampleFilter filter, const std::uint16_t* indices, int count,
                TapQueue& queue, ChannelPair* sums) {
  const int most = TapQueue::most_samples(filter);
  for (int k = 0; k < count; k += most)
    queue.add({filter, std::min(most, count - k), &b.x[k], &b.y[k], &b.z[k], &b.wide[k],
               &b.narrow[k], &b.ax[k], &b.ay[k], &b.az[k], indices + k},
              sums);
}

}  // namespace

SkySampler::SkySampler(const SkyMap& map, double black)
    : map_(map),
      texel_(static_cast<float>(std::numbers::pi / 2 / map.levels().front().size)),
      black_(static_cast<float>(black)) {}

void SkySampler::choose_filters(const float* wide, const float* narrow, int count, int most_taps,
                                float longest_line, SampleFilter* filters) const {
  TapLimits limits{};
  for (std::size_t j = 0; j < kTaps.size(); ++j) {
    limits.taps[j] = kTaps[j];
    limits.longest[j] = j == 0 ? kRound : static_cast<float>(kTaps[j]) * kSpacing;
    if (kTaps[j] >= most_taps) limits.longest[j] = HUGE_VALF;
  }
  static_assert(sizeof(SampleFilter) == 1);
  choose_texels(wide, narrow, count, texel_, limits, longest_line,
                reinterpret_cast<std::uint8_t*>(filters));
}

void SkySampler::sample_plain(const SampleBatch& batch, int count, float* rgb) const {
  // Only colour maps have a loop of their own for plain samples.
  if (map_.kind() == SkyMapKind::kThermal) {
    std::array<SampleFilter, kSamples> filters;
    filters.fill(SampleFilter(1, false));
    return sample(batch, count, filters.data(), rgb);
  }
  FinestTaps taps;
  const SkyLevel& finest = map_.levels().front();
  locate_plain(batch, count, finest.size, taps);
  const MapDevelopment how{luminance_weights(), black_, batch.gain.data()};
  if (simd_in_use() != Simd::kPortable)
    take_plain(finest, taps, how, count, rgb);
  else
    take_plain_by_halves(finest, taps, how, count, rgb);
}

void SkySampler::sample(const SampleBatch& batch, int count, const SampleFilter* filters,
                        float* rgb) const {
  const SortedByFilter sorted(filters, count);
  alignas(64) std::array<ChannelPair, kSamples> sums;
  std::fill_n(sums.begin(), count, ChannelPair{});
  TapQueue queue(map_, kSpacing);
  SampleBatch gathered;
  for (const int taps : kTaps)
    for (const bool minified : {false, true}) {
      const SampleFilter filter(taps, minified);
      const std::uint16_t* indices = sorted.indices(filter);
      const int members = sorted.count(filter);
      if (members == 0) continue;
      // Unless all samples have this filter, its samples are gathered, so that loops over them read
      // successive memory.
      if (members != count) {
        gather_points(batch, indices, members, gathered);
        if (taps > 1) gather_lines(batch, indices, members, gathered);
      }
      queue_taps(members == count ? batch : gathered, filter, indices, members, queue, sums.data());
    }
  queue.flush(sums.data());
  // Samples without taps must keep their values in rgb, so the others are copied one by one.
  std::array<float, 3 * kSamples + 1> lines;
  float* light = sorted.all_have_taps() ? rgb : lines.data();
  if (map_.kind() == SkyMapKind::kThermal)
    thermal_to_colours(sums.data(), black_, batch.gain.data(), batch.tone.data(), count, light);
  else
    to_colours(sums.data(), {luminance_weights(), black_, batch.gain.data()}, count, light);
  for (int k = 0; light != rgb && k < count; ++k)
    if (filters[k].taps() > 0) std::copy_n(light + 3 * k, 3, rgb + 3 * k);
}

}  // namespace domefall
