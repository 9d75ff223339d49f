#include "pipeline/render/sky/tap_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

// Texels are prefetched this many pairs before they are read.
constexpr int kPrefetchedPairs = 20;

using TapColumns = TapQueue::TapColumns;
using Column = std::array<float, 512>;
// The directions of taps, their widths in texels of the finest level (at least 1), and thresholds
// for the choice of a level.  The first taps of all samples are followed by all second taps, and so
// on.
struct TapPositions {
  alignas(64) Column x, y, z, texels, threshold;
};

struct MapSize {
  int size, last;  // as in TapQueue
};

// Puts tap k on a level.  The bits of (127 - level) << 23 are those of the float 2^-level.
[[gnu::always_inline]] inline void locate_on_level(const TapPositions& __restrict taps, int k,
                                                   MapSize map, std::int32_t level, int slot,
                                                   TapColumns& __restrict out) {
  const FloatFacePoint point = float_face_of(taps.x[k], taps.y[k], taps.z[k]);
  const float half_size =
      static_cast<float>(map.size) / 2 * std::bit_cast<float>((127 - level) << 23);
  locate_texels(point, half_size, (map.size >> level) + 2, out.texel[slot], out.fx[slot],
                out.fy[slot]);
  out.level[slot] = level;
}

// Puts taps on the finest level, into `out` from `slot` on.  Sets neither levels nor weights.
[[gnu::always_inline]] inline void locate_finest_loop(const TapPositions& __restrict taps,
                                                      int count, MapSize map, int slot,
                                                      TapColumns& __restrict out) {
  const float half_size = static_cast<float>(map.size) / 2;
  for (int k = 0; k < count; ++k) {
    const FloatFacePoint point = float_face_of(taps.x[k], taps.y[k], taps.z[k]);
    locate_texels(point, half_size, map.size + 2, out.texel[slot + k], out.fx[slot + k],
                  out.fy[slot + k]);
  }
}
Dispatched<locate_finest_loop> locate_finest;

// Puts taps on one of the two levels on either side of their width: the finer one (coarser = 0) or
// the coarser one (1).  A float's exponent is the octave of the width, its mantissa the part of the
// way to the next octave, by which the coarser level is weighted.
[[gnu::always_inline]] inline void locate_levels_loop(const TapPositions& __restrict taps,
                                                      int count, MapSize map, int coarser, int slot,
                                                      TapColumns& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(taps.texels[k]);
    const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127 + coarser;
    const std::int32_t level = octave < map.last ? octave : map.last;
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    locate_on_level(taps, k, map, level, slot + k, out);
    out.weight[slot + k] = coarser == 0 ? 1 - part : part;
  }
}
Dispatched<locate_levels_loop> locate_levels;

// Puts each tap on one level only: on the coarser one if that level's weight exceeds the tap's
// threshold.  The thresholds of a sample's taps are spread over (0, 1), so that as many of them
// take the coarser level as its weight asks for.
[[gnu::always_inline]] inline void locate_level_loop(const TapPositions& __restrict taps, int count,
                                                     MapSize map, int slot,
                                                     TapColumns& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(taps.texels[k]);
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const std::int32_t octave =
        static_cast<std::int32_t>(bits >> 23) - 127 + (part > taps.threshold[k] ? 1 : 0);
    const std::int32_t level = octave < map.last ? octave : map.last;
    locate_on_level(taps, k, map, level, slot + k, out);
    out.weight[slot + k] = 1;
  }
}
Dispatched<locate_level_loop> locate_level;

// Spreads taps evenly along the footprints, every `step`-th of them from `first_tap` on.  A tap is
// as wide as the footprint is narrow, or so wide that the taps stand `spacing` widths apart.
[[gnu::always_inline]] inline void place_line_loop(const FilteredSamples& samples, int first_tap,
                                                   int step, float texels_per_radian, float spacing,
                                                   TapPositions& out) {
  const FilteredSamples s = samples;
  const int taps = s.filter.taps();
  const float share = 1 / static_cast<float>(taps);
  for (int tap = first_tap, to = 0; tap < taps; tap += step, to += s.count) {
    const float along = (static_cast<float>(tap) + 0.5f) * share - 0.5f;
    // The fractions of multiples of the golden ratio are spread evenly, however many are taken.
    const double turns = (tap + 0.5) * (std::numbers::phi - 1);
    const auto threshold = static_cast<float>(turns - static_cast<int>(turns));
    for (int k = 0; k < s.count; ++k) {
      out.x[to + k] = s.x[k] + s.ax[k] * along;
      out.y[to + k] = s.y[k] + s.ay[k] * along;
      out.z[to + k] = s.z[k] + s.az[k] * along;
      const float spaced = s.wide[k] * (share / spacing);
      const float texels = (s.narrow[k] > spaced ? s.narrow[k] : spaced) * texels_per_radian;
      out.texels[to + k] = texels > 1 ? texels : 1;
      out.threshold[to + k] = threshold;
    }
  }
}
Dispatched<place_line_loop> place_line;

// Places the only taps of samples, each as wide as its footprint.
[[gnu::always_inline]] inline void place_single_loop(const FilteredSamples& samples,
                                                     float texels_per_radian, TapPositions& out) {
  const FilteredSamples s = samples;
  for (int k = 0; k < s.count; ++k) {
    out.x[k] = s.x[k];
    out.y[k] = s.y[k];
    out.z[k] = s.z[k];
    const float texels = s.wide[k] * texels_per_radian;
    out.texels[k] = texels > 1 ? texels : 1;
  }
}
Dispatched<place_single_loop> place_single;

[[gnu::always_inline]] inline WeightedTap weighted_tap(const MipLevels& levels,
                                                       const TapColumns& taps, int k) {
  const std::int32_t level = taps.level[k];
  return {levels.texels[level] + taps.texel[k], levels.stride[level], taps.fx[k], taps.fy[k],
          taps.weight[k]};
}

[[gnu::always_inline]] inline void prefetch_tap(const MipLevels& levels, const TapColumns& taps,
                                                int k) {
  const std::int32_t level = taps.level[k];
  prefetch_texels(levels.texels[level] + taps.texel[k], levels.stride[level]);
}

template <bool kWide>
[[gnu::always_inline]] inline void take_weighted_loop(const MipLevels& levels, const TapColumns& a,
                                                      const TapColumns& b,
                                                      const std::uint16_t* indices, int count,
                                                      ChannelPair* sums) {
  for (int k = 0; k < count; ++k) {
    const int later = std::min(k + kPrefetchedPairs, count - 1);
    prefetch_tap(levels, a, later);
    prefetch_tap(levels, b, later);
    ChannelPair light;
    take_pair<kWide>(weighted_tap(levels, a, k), weighted_tap(levels, b, k), light);
    sums[indices[k]] += light;
  }
}
Dispatched<take_weighted_loop<true>> take_weighted;
Dispatched<take_weighted_loop<false>> take_weighted_one_by_one;

template <bool kWide>
[[gnu::always_inline]] inline void take_finest_loop(const SkyTexel* texels, int stride,
                                                    const TapColumns& a, const TapColumns& b,
                                                    const std::uint16_t* indices, int count,
                                                    ChannelPair* sums) {
  for (int k = 0; k < count; ++k) {
    const int later = std::min(k + kPrefetchedPairs, count - 1);
    prefetch_texels(texels + a.texel[later], stride);
    prefetch_texels(texels + b.texel[later], stride);
    ChannelPair light;
    take_pair<kWide>({texels + a.texel[k], stride, a.fx[k], a.fy[k], 1},
                     {texels + b.texel[k], stride, b.fx[k], b.fy[k], 1}, light);
    sums[indices[k]] += light;
  }
}
Dispatched<take_finest_loop<true>> take_finest;
Dispatched<take_finest_loop<false>> take_finest_one_by_one;

}  // namespace

TapQueue::TapQueue(const SkyMap& map, double spacing)
    : levels_(mip_levels(map)),
      size_(map.levels().front().size),
      last_(static_cast<int>(map.levels().size()) - 1),
      texels_per_radian_(static_cast<float>(size_ * 2 / std::numbers::pi)),
      spacing_(static_cast<float>(spacing)) {}

void TapQueue::locate(const FilteredSamples& samples, PendingPairs& pending) const {
  const MapSize map{size_, last_};
  const SampleFilter filter = samples.filter;
  const bool two_levels = on_two_levels(filter);
  const int count = pairs(filter) * samples.count, slot = pending.count;
  TapPositions positions;
  for (int half = 0; half < 2; ++half) {
    TapColumns& out = pending.taps[static_cast<std::size_t>(half)];
    if (filter.taps() == 1)
      place_single(samples, texels_per_radian_, positions);
    else if (!two_levels)
      place_line(samples, half, 2, texels_per_radian_, spacing_, positions);
    else if (half == 0)  // the second half of each pair is the same tap on another level
      place_line(samples, 0, 1, texels_per_radian_, spacing_, positions);
    if (two_levels)
      locate_levels(positions, count, map, half, slot, out);
    else if (filter.minified())
      locate_level(positions, count, map, slot, out);
    else
      locate_finest(positions, count, map, slot, out);
    if (!filter.is_plain()) continue;
    // A plain sample has one tap.  It fills both halves of its pair, the second with the weight 0.
    std::fill_n(&out.level[slot], count, 0);
    std::fill_n(&out.weight[slot], count, half == 0 ? 1.0f : 0.0f);
  }
}

void TapQueue::add(const FilteredSamples& samples, ChannelPair* sums) {
  if (std::max(finest_.count, weighted_.count) + kMostPairs > kCapacity) flush(sums);
  const SampleFilter filter = samples.filter;
  PendingPairs& pending = filter.minified() || filter.is_plain() ? weighted_ : finest_;
  locate(samples, pending);
  for (int k = 0; k < pairs(filter); ++k, pending.count += samples.count)
    std::copy_n(samples.indices, samples.count, &pending.indices[pending.count]);
}

void TapQueue::flush(ChannelPair* sums) {
  const auto take = [&](const auto& loop, const PendingPairs& pending, const auto&... map) {
    loop(map..., pending.taps[0], pending.taps[1], pending.indices.data(), pending.count, sums);
  };
  const SkyTexel* texels = levels_.texels[0];
  const int stride = levels_.stride[0];
  if (simd_in_use() != Simd::kPortable) {
    take(take_weighted, weighted_, levels_);
    take(take_finest, finest_, texels, stride);
  } else {
    take(take_weighted_one_by_one, weighted_, levels_);
    take(take_finest_one_by_one, finest_, texels, stride);
  }
  weighted_.count = finest_.count = 0;
}

}  // namespace domefall
