#include "pipeline/render/sky/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/sky/tap_queue.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

constexpr int kSize = SampleBatch::kSize;
// A footprint up to this many times as long as wide, or as a texel, has one tap as wide as it is
// long.
constexpr float kRound = 1.25f;
// The taps of a line stand at most this many of their widths apart.
constexpr float kSpacing = 1.5f;
constexpr std::array<int, 9> kTaps{1, 2, 4, 6, 8, 12, 16, 24, SkySampler::kMostTaps};
// Texels are prefetched this many plain samples before they are read.
constexpr int kPrefetchedSamples = 40;

// Where plain samples fall on the finest level.
struct FinestTaps {
  alignas(64) std::array<std::int32_t, kSize> texel;
  alignas(64) std::array<float, kSize> fx, fy;
};

[[gnu::always_inline]] inline void locate_plain_loop(const SampleBatch& batch, int count, int size,
                                                     FinestTaps& taps) {
  const float half_size = static_cast<float>(size) / 2;
  for (int k = 0; k < count; ++k) {
    const FloatFacePoint point = float_face_of(batch.x[k], batch.y[k], batch.z[k]);
    locate_texels(point, half_size, size + 2, taps.texel[k], taps.fx[k], taps.fy[k]);
  }
}
Dispatched<locate_plain_loop> locate_plain;

// The weights of the channels in luminance, for two samples side by side, and the luminance that is
// black in all lanes.
struct Black {
  ChannelPair weights, level;

  explicit Black(float black) {
    const auto& w = luminance_weights();
    weights = ChannelPair{w[0], w[1], w[2], 0, w[0], w[1], w[2], 0};
    broadcast(black, black, level);
  }
};

// Lowers the luminance of two samples by the black level, or to 0, and keeps their hue.  The level
// exceeds 0, so that a dark sample gives -infinity before it gives 0.
[[gnu::always_inline]] inline void take_black(const Black& black, ChannelPair& light) {
  ChannelPair luminance = light * black.weights;
  luminance += __builtin_shufflevector(luminance, luminance, 1, 0, 3, 2, 5, 4, 7, 6);
  luminance += __builtin_shufflevector(luminance, luminance, 2, 3, 0, 1, 6, 7, 4, 5);
  const ChannelPair kept = 1 - black.level / luminance;
  light *= kept > 0 ? kept : ChannelPair{};
}

// Takes plain samples, which are most samples of most frames, in a loop of their own.  `count` is
// even.  Of four channels the last is 0; the next sample's first overwrites it.
template <bool kWide, bool kBlack>
[[gnu::always_inline]] inline void take_plain_loop(const SkyLevel& level, const FinestTaps& taps,
                                                   const Black& black, const float* gain, int count,
                                                   float* rgb) {
  const SkyTexel* texels = level.texels;
  const int stride = level.size + 2;
  for (int k = 0; k < count; k += 2, rgb += 6) {
    const int later = std::min(k + kPrefetchedSamples, count - 2);
    prefetch_texels(texels + taps.texel[later], stride);
    prefetch_texels(texels + taps.texel[later + 1], stride);
    ChannelPair light;
    take_pair<kWide>(
        {texels + taps.texel[k], stride, taps.fx[k], taps.fy[k], kTapScale},
        {texels + taps.texel[k + 1], stride, taps.fx[k + 1], taps.fy[k + 1], kTapScale}, light);
    if constexpr (kBlack) take_black(black, light);
    Channels samples[2];
    std::memcpy(samples, &light, sizeof samples);
    samples[0] *= gain[k];
    samples[1] *= gain[k + 1];
    std::memcpy(rgb, &samples[0], sizeof samples[0]);
    std::memcpy(rgb + 3, &samples[1], sizeof samples[1]);
  }
}
Dispatched<take_plain_loop<true, false>> take_plain;
Dispatched<take_plain_loop<true, true>> take_plain_above_black;
Dispatched<take_plain_loop<false, false>> take_plain_one_by_one;
Dispatched<take_plain_loop<false, true>> take_plain_above_black_one_by_one;

// Adds the two halves of a sample's sum.
[[gnu::always_inline]] inline void total(const ChannelPair& sum, Channels& light) {
  light = (__builtin_shufflevector(sum, sum, 0, 1, 2, 3) +
           __builtin_shufflevector(sum, sum, 4, 5, 6, 7)) *
          kTapScale;
}

template <bool kBlack>
[[gnu::always_inline]] inline void to_colours_loop(const ChannelPair* sums, const Black& black,
                                                   const float* gain, const SampleFilter* filters,
                                                   int count, float* rgb) {
  for (int k = 0; k < count; ++k, rgb += 3) {
    if (filters[k].taps() == 0) continue;
    Channels light;
    total(sums[k], light);
    const auto taps = static_cast<float>(filters[k].taps());
    if constexpr (kBlack) {
      light *= 1 / taps;
      ChannelPair pair = __builtin_shufflevector(light, light, 0, 1, 2, 3, 0, 1, 2, 3);
      take_black(black, pair);
      light = __builtin_shufflevector(pair, pair, 0, 1, 2, 3) * gain[k];
    } else {
      light *= gain[k] / taps;
    }
    rgb[0] = light[0];
    rgb[1] = light[1];
    rgb[2] = light[2];
  }
}
Dispatched<to_colours_loop<false>> to_colours;
Dispatched<to_colours_loop<true>> to_colours_above_black;

// The first two channels of a thermal map are the radiance I and I theta (SkyMapKind::kThermal), so
// that their ratio is the mean of theta.  The temperature is raised by `tone` octaves.
void thermal_to_colours(const ChannelPair* sums, float black, const float* gain, const float* tone,
                        const SampleFilter* filters, int count, float* rgb) {
  static const auto base = static_cast<float>(std::log2(kThermalBase));
  const BlackbodyColours& colours = blackbody_colours();
  for (int k = 0; k < count; ++k, rgb += 3) {
    if (filters[k].taps() == 0) continue;
    Channels sum;
    total(sums[k], sum);
    const float radiance = sum[0] / static_cast<float>(filters[k].taps()) - black;
    WorkingRgb colour{0, 0, 0};
    if (radiance > 0) colour = colours.per_flux_log2(base + sum[1] / sum[0] + tone[k]);
    const float scale = radiance * gain[k];
    rgb[0] = colour.r * scale;
    rgb[1] = colour.g * scale;
    rgb[2] = colour.b * scale;
  }
}

// The longest footprint, in units of its width, that each number of taps is enough for.
struct TapLimits {
  std::array<int, kTaps.size()> taps;
  std::array<float, kTaps.size()> longest;
};

[[gnu::always_inline]] inline void choose_loop(const float* wide, const float* narrow, int count,
                                               float texel, const TapLimits& limits,
                                               float longest_line, std::uint8_t* codes) {
  const TapLimits l = limits;
  for (int k = 0; k < count; ++k) {
    const float elongation = wide[k] / (narrow[k] > texel ? narrow[k] : texel);
    int wanted = 1;
    for (std::size_t j = 1; j < l.taps.size(); ++j)
      wanted = elongation > l.longest[j - 1] ? l.taps[j] : wanted;
    const int taps = wide[k] < longest_line ? wanted : 1;
    const float spaced = wide[k] / (static_cast<float>(taps) * kSpacing);
    const float tap_width = taps == 1 ? wide[k] : narrow[k] > spaced ? narrow[k] : spaced;
    codes[k] = static_cast<std::uint8_t>(2 * taps + (tap_width > texel ? 1 : 0));
  }
}
Dispatched<choose_loop> choose;

constexpr std::array<std::uint16_t, kSize + 1> kNumbers = [] {
  std::array<std::uint16_t, kSize + 1> numbers{};
  for (int k = 0; k <= kSize; ++k) numbers[k] = static_cast<std::uint16_t>(k);
  return numbers;
}();

// The indices of samples, sorted by their filters.
class SortedByFilter {
 public:
  SortedByFilter(const SampleFilter* filters, int count) {
    ends_.fill(0);
    each_run(filters, count, [](int& members, int first, int end) { members += end - first; });
    // Each count becomes the start of its filter's indices, which moves on to their end as they are
    // copied.
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

 private:
  // Calls f(ends_[code], first, end) for each run of samples with one filter.  Runs are mostly
  // long, since neighbours are alike, and so eight filters are compared at a time.
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

  std::array<std::uint16_t, kSize> indices_;
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

// Queues the taps of the first `count` samples of a batch, all of one filter.
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
  choose(wide, narrow, count, texel_, limits, longest_line,
         reinterpret_cast<std::uint8_t*>(filters));
}

void SkySampler::sample_plain(const SampleBatch& batch, int count, float* rgb) const {
  if (map_.kind() == SkyMapKind::kThermal || count % 2 != 0) {
    std::array<SampleFilter, kSize> filters;
    filters.fill(SampleFilter(1, false));
    return sample(batch, count, filters.data(), rgb);
  }
  FinestTaps taps;
  const SkyLevel& finest = map_.levels().front();
  locate_plain(batch, count, finest.size, taps);
  const Black black(black_);
  const auto take = [&](const auto& loop) {
    loop(finest, taps, black, batch.gain.data(), count, rgb);
  };
  if (simd_in_use() != Simd::kPortable)
    black_ > 0 ? take(take_plain_above_black) : take(take_plain);
  else
    black_ > 0 ? take(take_plain_above_black_one_by_one) : take(take_plain_one_by_one);
}

void SkySampler::sample(const SampleBatch& batch, int count, const SampleFilter* filters,
                        float* rgb) const {
  const SortedByFilter sorted(filters, count);
  alignas(64) std::array<ChannelPair, kSize> sums;
  std::fill_n(sums.begin(), count, ChannelPair{});
  TapQueue queue(map_, kSpacing);
  SampleBatch gathered;
  for (const int taps : kTaps)
    for (const bool minified : {false, true}) {
      const SampleFilter filter(taps, minified);
      const std::uint16_t* indices = sorted.indices(filter);
      const int members = sorted.count(filter);
      if (members == 0) continue;
      if (members != count) {
        gather_points(batch, indices, members, gathered);
        if (taps > 1) gather_lines(batch, indices, members, gathered);
      }
      queue_taps(members == count ? batch : gathered, filter, indices, members, queue, sums.data());
    }
  queue.flush(sums.data());
  if (map_.kind() == SkyMapKind::kThermal)
    thermal_to_colours(sums.data(), black_, batch.gain.data(), batch.tone.data(), filters, count,
                       rgb);
  else if (black_ > 0)
    to_colours_above_black(sums.data(), Black(black_), batch.gain.data(), filters, count, rgb);
  else
    to_colours(sums.data(), Black(black_), batch.gain.data(), filters, count, rgb);
}

}  // namespace domefall
