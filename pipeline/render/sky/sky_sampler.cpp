#include "pipeline/render/sky/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/sky/texel_queue.h"
#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

constexpr int kChunk = FootprintBatch::kSize;
// An oblong that is nearly round, or nearly a texel, is blurred to its length.
constexpr float kRound = 1.25f;
// How far apart the looks of a line are at most, in their widths.
constexpr float kSpacing = 1.5f;
constexpr std::array<int, 9> kTaps{1, 2, 4, 6, 8, 12, 16, 24, SkySampler::kMostTaps};
// Texels are asked for so many looks ahead.
constexpr int kAhead = 40;

// Between which texels of the finest level looks fall.
struct TexelIndices {
  alignas(64) std::array<std::int32_t, kChunk> at;
  alignas(64) std::array<float, kChunk> fx, fy;
};

[[gnu::always_inline]] inline void locate_loop(const FootprintBatch& places, int count, int size,
                                               TexelIndices& spots) {
  const float half_size = static_cast<float>(size) / 2;
  for (int k = 0; k < count; ++k) {
    const OnFace on = on_face(places.x[k], places.y[k], places.z[k]);
    place_on(on, half_size, size + 2, spots.at[k], spots.fx[k], spots.fy[k]);
  }
}
Dispatched<locate_loop> locate;

// One look a pixel at the finest level: the bulk of most frames, in one loop.  `count` is even.
template <bool kWide>
[[gnu::always_inline]] inline void fine_colours_loop(const SkyLevel& level, const TexelIndices& s,
                                                     const float* gain, int count, float* rgb) {
  const SkyTexel* texels = level.texels;
  const int side = level.size + 2;
  for (int k = 0; k < count; k += 2, rgb += 6) {
    const int later = std::min(k + kAhead, count - 2);
    prefetch(texels + s.at[later], side), prefetch(texels + s.at[later + 1], side);
    Pair light;
    sample_pair<kWide>({texels + s.at[k], side, s.fx[k], s.fy[k], kTexelScale},
                       {texels + s.at[k + 1], side, s.fx[k + 1], s.fy[k + 1], kTexelScale}, light);
    Four both[2];
    std::memcpy(both, &light, sizeof both);
    both[0] *= gain[k], both[1] *= gain[k + 1];
    std::memcpy(rgb, &both[0],
                sizeof both[0]);  // the fourth is 0, and the next pixel's to overwrite
    std::memcpy(rgb + 3, &both[1], sizeof both[1]);
  }
}
Dispatched<fine_colours_loop<true>> fine_colours;
Dispatched<fine_colours_loop<false>> fine_colours_narrowly;

// All light of a pixel.
[[gnu::always_inline]] inline void whole(const Pair& sum, Four& light) {
  light = (__builtin_shufflevector(sum, sum, 0, 1, 2, 3) +
           __builtin_shufflevector(sum, sum, 4, 5, 6, 7)) *
          kTexelScale;
}

[[gnu::always_inline]] inline void to_colours_loop(const Pair* sum, const float* gain,
                                                   const SampleKind* kinds, int count, float* rgb) {
  for (int k = 0; k < count; ++k, rgb += 3) {
    if (kinds[k].taps() == 0) continue;
    Four c;
    whole(sum[k], c);
    c *= gain[k] / static_cast<float>(kinds[k].taps());
    rgb[0] = c[0], rgb[1] = c[1], rgb[2] = c[2];
  }
}
Dispatched<to_colours_loop> to_colours;

// I and I theta of blackbody light, shifted by `tone` octaves of temperature.
void thermal_to_colours(const Pair* sum, const float* gain, const float* tone,
                        const SampleKind* kinds, int count, float* rgb) {
  static const auto base = static_cast<float>(std::log2(kThermalBase));
  const BlackbodyColours& colours = blackbody_colours();
  for (int k = 0; k < count; ++k, rgb += 3) {
    if (kinds[k].taps() == 0) continue;
    Four of;
    whole(sum[k], of);
    const float light = of[0];
    WorkingRgb c{0, 0, 0};
    if (light > 0) c = colours.per_flux_log2(base + of[1] / light + tone[k]);
    const float f = light * gain[k] / static_cast<float>(kinds[k].taps());
    rgb[0] = c.r * f, rgb[1] = c.g * f, rgb[2] = c.b * f;
  }
}

// With how many taps footprints are looked at up to which length, in units of their widths.
struct TapLimits {
  std::array<int, kTaps.size()> taps;
  std::array<float, kTaps.size()> longest;
};

[[gnu::always_inline]] inline void choose_loop(const float* wide, const float* narrow, int count,
                                               float texel, const TapLimits& limits, float longest,
                                               std::uint8_t* codes) {
  const TapLimits l = limits;
  for (int k = 0; k < count; ++k) {
    const float wanted = wide[k] / (narrow[k] > texel ? narrow[k] : texel);
    int several = 1;
    for (std::size_t j = 1; j < l.taps.size(); ++j)
      several = wanted > l.longest[j - 1] ? l.taps[j] : several;
    const int taps = wide[k] < longest ? several : 1;
    const float each = wide[k] / (static_cast<float>(taps) * kSpacing);
    const float blur = taps == 1 ? wide[k] : narrow[k] > each ? narrow[k] : each;
    codes[k] = static_cast<std::uint8_t>(2 * taps + (blur > texel ? 1 : 0));
  }
}
Dispatched<choose_loop> choose;

constexpr std::array<std::uint16_t, kChunk + 1> kNumbers = [] {
  std::array<std::uint16_t, kChunk + 1> numbers{};
  for (int k = 0; k <= kChunk; ++k) numbers[k] = static_cast<std::uint16_t>(k);
  return numbers;
}();

// The numbers of the looks by their kind.
class Order {
 public:
  Order(const SampleKind* kinds, int count) {
    ends_.fill(0);
    each_run(kinds, count, [](int& members, int first, int end) { members += end - first; });
    for (int before = 0; int& end : ends_) {
      const int members = end;
      end = before;  // the start, until they are in
      before += members;
    }
    each_run(kinds, count, [this](int& to, int first, int end) {
      std::copy(&kNumbers[first], &kNumbers[end], &who_[to]);
      to += end - first;
    });
  }

  struct Group {
    const std::uint16_t* who;
    int members;
  };
  Group group(SampleKind kind) const {
    const int first = ends_[kind.code() - 1];
    return {&who_[first], ends_[kind.code()] - first};
  }

 private:
  // Neighbours are mostly of one kind: eight at a time.
  template <class F>
  void each_run(const SampleKind* kinds, int count, F&& f) {
    for (int first = 0, end = 0; first < count; first = end) {
      std::array<SampleKind, 8> like, next;
      like.fill(kinds[first]);
      for (; end + 8 <= count; end += 8) {
        std::copy_n(kinds + end, 8, next.begin());
        if (next != like) break;
      }
      while (end < count && kinds[end] == kinds[first]) ++end;
      f(ends_[kinds[first].code()], first, end);
    }
  }

  std::array<std::uint16_t, kChunk> who_;
  std::array<int, 2 * SkySampler::kMostTaps + 2> ends_;  // by code: where they end in who_
};

[[gnu::always_inline]] inline void gather_points_loop(const FootprintBatch& __restrict from,
                                                      const std::uint16_t* who, int count,
                                                      FootprintBatch& __restrict to) {
  for (int m = 0; m < count; ++m) {
    const int k = who[m];
    to.x[m] = from.x[k], to.y[m] = from.y[k], to.z[m] = from.z[k], to.wide[m] = from.wide[k];
  }
}
Dispatched<gather_points_loop> gather_points;

[[gnu::always_inline]] inline void gather_lines_loop(const FootprintBatch& __restrict from,
                                                     const std::uint16_t* who, int count,
                                                     FootprintBatch& __restrict to) {
  for (int m = 0; m < count; ++m) {
    const int k = who[m];
    to.narrow[m] = from.narrow[k];
    to.ax[m] = from.ax[k], to.ay[m] = from.ay[k], to.az[m] = from.az[k];
  }
}
Dispatched<gather_lines_loop> gather_lines;

// Looks at `members` places of one kind.
void add_group(const FootprintBatch& p, SampleKind kind, const std::uint16_t* who, int members,
               TexelQueue& looks, Pair* sums) {
  const int at_once = TexelQueue::most_members(kind.taps(), kind.minified());
  for (int k = 0; k < members; k += at_once)
    looks.add({kind.taps(), std::min(at_once, members - k), kind.minified(), &p.x[k], &p.y[k],
               &p.z[k], &p.wide[k], &p.narrow[k], &p.ax[k], &p.ay[k], &p.az[k], who + k},
              sums);
}

}  // namespace

SkySampler::SkySampler(const SkyMap& map)
    : map_(map), texel_(static_cast<float>(std::numbers::pi / 2 / map.levels().front().size)) {}

void SkySampler::choose_kinds(const float* wide, const float* narrow, int count, int most,
                              float longest, SampleKind* kinds) const {
  TapLimits limits{};
  for (std::size_t j = 0; j < kTaps.size(); ++j) {
    limits.taps[j] = kTaps[j];
    limits.longest[j] = j == 0 ? kRound : static_cast<float>(kTaps[j]) * kSpacing;
    if (kTaps[j] >= most) limits.longest[j] = HUGE_VALF;
  }
  static_assert(sizeof(SampleKind) == 1);
  choose(wide, narrow, count, texel_, limits, longest, reinterpret_cast<std::uint8_t*>(kinds));
}

void SkySampler::sample_plain(const FootprintBatch& places, int count, float* rgb) const {
  if (map_.kind() == SkyMapKind::kThermal || count % 2 != 0) {
    std::array<SampleKind, kChunk> kinds;
    kinds.fill(SampleKind(1, false));
    return sample(places, count, kinds.data(), rgb);
  }
  TexelIndices spots;
  locate(places, count, map_.levels().front().size, spots);
  const SkyLevel& finest = map_.levels().front();
  if (simd_in_use() == Simd::kPortable)
    fine_colours_narrowly(finest, spots, places.gain.data(), count, rgb);
  else
    fine_colours(finest, spots, places.gain.data(), count, rgb);
}

void SkySampler::sample(const FootprintBatch& places, int count, const SampleKind* kinds,
                        float* rgb) const {
  const Order order(kinds, count);
  alignas(64) std::array<Pair, kChunk> sums;
  std::fill_n(sums.begin(), count, Pair{});
  TexelQueue looks(map_, kSpacing);
  FootprintBatch group;
  for (const int taps : kTaps)
    for (const bool minified : {false, true}) {
      const SampleKind kind(taps, minified);
      const auto [who, members] = order.group(kind);
      if (members == 0) continue;
      if (members != count) {
        gather_points(places, who, members, group);
        if (taps > 1) gather_lines(places, who, members, group);
      }
      add_group(members == count ? places : group, kind, who, members, looks, sums.data());
    }
  looks.take(sums.data());
  if (map_.kind() == SkyMapKind::kThermal)
    thermal_to_colours(sums.data(), places.gain.data(), places.tone.data(), kinds, count, rgb);
  else
    to_colours(sums.data(), places.gain.data(), kinds, count, rgb);
}

}  // namespace domefall
