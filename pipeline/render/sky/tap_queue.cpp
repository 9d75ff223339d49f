#include "pipeline/render/sky/tap_queue.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"

namespace domefall {
namespace {

// Texels are prefetched this many taps before they are read.
constexpr int kPrefetchedTaps = 80;

using Taps = TapQueue::Taps;
// A call of TapQueue::add() places at most 512 taps (kMostPlaces).
using Column = std::array<float, 512>;
// TapPositions holds the directions of taps, their widths in texels of the finest level (at least
// 1), and thresholds for the choice of a level.  First come the first taps of all samples, then all
// second taps, and so on.
struct TapPositions {
  alignas(64) Column x, y, z, texels, threshold;
};

struct MapSize {
  int size, last;  // as in TapQueue
};

// Puts tap k on a level, as the tap `slot` of `out`.  The bits (127 - level) << 23 are those of the
// float 2^-level.
[[gnu::always_inline]] inline void locate_on_level(const TapPositions& __restrict taps, int k,
                                                   MapSize map, std::int32_t level, float factor,
                                                   int slot, Taps& __restrict out) {
  const FloatFacePoint point = float_face_of(taps.x[k], taps.y[k], taps.z[k]);
  const float half_size =
      static_cast<float>(map.size) / 2 * std::bit_cast<float>((127 - level) << 23);
  float fx, fy;
  locate_texels(point, half_size, (map.size >> level) + 2, out.texel[slot], fx, fy);
  weigh_texels(fx, fy, factor, out.weights[slot]);
  out.level[slot] = level;
}

// Puts taps on the finest level and does not set their levels.
[[gnu::always_inline]] inline void locate_finest_loop(const TapPositions& __restrict taps,
                                                      int count, MapSize map, float share, int slot,
                                                      Taps& __restrict out) {
  const float half_size = static_cast<float>(map.size) / 2;
  for (int k = 0; k < count; ++k) {
    const FloatFacePoint point = float_face_of(taps.x[k], taps.y[k], taps.z[k]);
    float fx, fy;
    locate_texels(point, half_size, map.size + 2, out.texel[slot + k], fx, fy);
    weigh_texels(fx, fy, share, out.weights[slot + k]);
  }
}
Dispatched<locate_finest_loop> locate_finest;

// Puts taps on one of the two levels that enclose their width: the finer one (coarser = 0) or the
// coarser one (1).  The exponent of a float is the octave of the width.  Its mantissa says how far
// the width is on its way to the next octave, and this part is the weight of the coarser level.
[[gnu::always_inline]] inline void locate_levels_loop(const TapPositions& __restrict taps,
                                                      int count, MapSize map, float share,
                                                      int coarser, int slot, Taps& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(taps.texels[k]);
    const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127 + coarser;
    const std::int32_t level = octave < map.last ? octave : map.last;
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    locate_on_level(taps, k, map, level, (coarser == 0 ? 1 - part : part) * share, slot + k, out);
  }
}
Dispatched<locate_levels_loop> locate_levels;

// Puts each tap on one level only.  This is the coarser one if that level's weight exceeds the
// tap's threshold.  The thresholds of a sample's taps are spread over (0, 1), so that the coarser
// level gets the share of taps that its weight asks for.
[[gnu::always_inline]] inline void locate_level_loop(const TapPositions& __restrict taps, int count,
                                                     MapSize map, float share, int slot,
                                                     Taps& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(taps.texels[k]);
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const std::int32_t octave =
        static_cast<std::int32_t>(bits >> 23) - 127 + (part > taps.threshold[k] ? 1 : 0);
    locate_on_level(taps, k, map, octave < map.last ? octave : map.last, share, slot + k, out);
  }
}
Dispatched<locate_level_loop> locate_level;

// Spreads taps evenly along the footprints.  A tap is as wide as the footprint's shorter side, or
// wider if the taps would otherwise be more than `spacing` widths apart.
[[gnu::always_inline]] inline void place_line_loop(const FilteredSamples& samples,
                                                   float texels_per_radian, float spacing,
                                                   TapPositions& out) {
  const FilteredSamples s = samples;
  const int taps = s.filter.taps();
  const float share = 1 / static_cast<float>(taps);
  for (int tap = 0, to = 0; tap < taps; ++tap, to += s.count) {
    // The line has `taps` equal parts, and each tap is in the middle of one.
    const float along = (static_cast<float>(tap) + 0.5f) * share - 0.5f;
    // The fractional parts of multiples of the golden ratio are spread evenly, however many are
    // taken.
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

// Places the taps of samples that have one each.  A tap is as wide as its footprint is long.
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

template <bool kWide>
[[gnu::always_inline]] inline void take_levelled_loop(const MipLevels& levels, const Taps& taps,
                                                      ChannelPair* sums) {
  const int count = taps.count;
  for (int k = 0; k < count; ++k) {
    const int later = std::min(k + kPrefetchedTaps, count - 1);
    const std::int32_t ahead = taps.level[later], level = taps.level[k];
    prefetch_texels(levels.texels[ahead] + taps.texel[later], levels.stride[ahead]);
    ChannelPair light;
    take_texels<kWide>(levels.texels[level] + taps.texel[k], levels.stride[level], taps.weights[k],
                       light);
    sums[taps.indices[k]] += light;
  }
}
Dispatched<take_levelled_loop<true>> take_levelled;
Dispatched<take_levelled_loop<false>> take_levelled_by_halves;

template <bool kWide>
[[gnu::always_inline]] inline void take_finest_loop(const SkyTexel* texels, int stride,
                                                    const Taps& taps, ChannelPair* sums) {
  const int count = taps.count;
  for (int k = 0; k < count; ++k) {
    prefetch_texels(texels + taps.texel[std::min(k + kPrefetchedTaps, count - 1)], stride);
    ChannelPair light;
    take_texels<kWide>(texels + taps.texel[k], stride, taps.weights[k], light);
    sums[taps.indices[k]] += light;
  }
}
Dispatched<take_finest_loop<true>> take_finest;
Dispatched<take_finest_loop<false>> take_finest_by_halves;

}  // namespace

TapQueue::TapQueue(const SkyMap& map, double spacing)
    : levels_(mip_levels(map)),
      size_(map.levels().front().size),
      last_(static_cast<int>(map.levels().size()) - 1),
      texels_per_radian_(static_cast<float>(size_ * 2 / std::numbers::pi)),
      spacing_(static_cast<float>(spacing)) {}

void TapQueue::locate(const FilteredSamples& samples, Taps& queued) const {
  const MapSize map{size_, last_};
  const SampleFilter filter = samples.filter;
  const int count = filter.taps() * samples.count;
  const float share = 1 / static_cast<float>(filter.taps());
  // number() sets to which sums the next queued taps belong.
  const auto number = [&] {
    for (int tap = 0; tap < filter.taps(); ++tap, queued.count += samples.count)
      std::copy_n(samples.indices, samples.count, &queued.indices[queued.count]);
  };
  TapPositions positions;
  if (filter.taps() == 1)
    place_single(samples, texels_per_radian_, positions);
  else
    place_line(samples, texels_per_radian_, spacing_, positions);
  if (on_two_levels(filter)) {
    // Each tap is queued twice, once for each level.
    locate_levels(positions, count, map, share, 0, queued.count, queued);
    number();
    locate_levels(positions, count, map, share, 1, queued.count, queued);
  } else if (filter.minified()) {
    locate_level(positions, count, map, share, queued.count, queued);
  } else {
    locate_finest(positions, count, map, share, queued.count, queued);
  }
  number();
}

void TapQueue::add(const FilteredSamples& samples, ChannelPair* sums) {
  const SampleFilter filter = samples.filter;
  const int taps = filter.taps() * (on_two_levels(filter) ? 2 : 1);
  Taps& queued = filter.minified() ? levelled_ : finest_;
  if (queued.count + taps * samples.count > kCapacity) flush(sums);
  locate(samples, queued);
}

void TapQueue::flush(ChannelPair* sums) {
  if (simd_in_use() != Simd::kPortable) {
    take_levelled(levels_, levelled_, sums);
    take_finest(levels_.texels[0], levels_.stride[0], finest_, sums);
  } else {
    take_levelled_by_halves(levels_, levelled_, sums);
    take_finest_by_halves(levels_.texels[0], levels_.stride[0], finest_, sums);
  }
  levelled_.count = finest_.count = 0;
}

}  // namespace domefall
