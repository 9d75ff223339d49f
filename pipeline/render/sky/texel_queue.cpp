#include "pipeline/render/sky/texel_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/simd/dispatch.h"

namespace domefall {
namespace {

// Texels are asked for so many pairs of looks ahead.
constexpr int kAhead = 20;

using TexelIndices = TexelQueue::TexelIndices;
using Column = std::array<float, 512>;
// Places on the sky and widths (in texels of the finest level) of looks: those of all members, again and
// again for each tap.
struct Spread {
  alignas(64) Column x, y, z, texels, threshold;
};

struct Map {
  int size, last;
};

// Into `out` from element `first` on.  Neither levels nor weights.
[[gnu::always_inline]] inline void locate_finest_loop(const Spread& __restrict s, int count,
                                                      Map map, int first,
                                                      TexelIndices& __restrict out) {
  const float half_size = static_cast<float>(map.size) / 2;
  for (int k = 0; k < count; ++k) {
    const OnFace on = on_face(s.x[k], s.y[k], s.z[k]);
    place_on(on, half_size, map.size + 2, out.at[first + k], out.fx[first + k], out.fy[first + k]);
  }
}
Dispatched<locate_finest_loop> locate_finest;

// Levels by the logarithm of the width in texels, straight between powers of two: the finer one, or the
// coarser one.
[[gnu::always_inline]] inline void locate_levels_loop(const Spread& __restrict s, int count,
                                                      Map map, int coarser, int first,
                                                      TexelIndices& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(s.texels[k]);
    const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127 + coarser;
    const std::int32_t level = octave < map.last ? octave : map.last;
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const OnFace on = on_face(s.x[k], s.y[k], s.z[k]);
    place_on(on, static_cast<float>(map.size) / 2 * std::bit_cast<float>((127 - level) << 23),
             (map.size >> level) + 2, out.at[first + k], out.fx[first + k], out.fy[first + k]);
    out.level[first + k] = level;
    out.weight[first + k] = coarser == 0 ? 1 - part : part;
  }
}
Dispatched<locate_levels_loop> locate_levels;

// The same for one of many looks of a pixel: each keeps to one level, and as many of them to the coarser one
// as its part asks for.  The threshold is in (0, 1), another one for each look.
[[gnu::always_inline]] inline void locate_level_loop(const Spread& __restrict s, int count, Map map,
                                                     int first, TexelIndices& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const auto bits = std::bit_cast<std::uint32_t>(s.texels[k]);
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const std::int32_t octave =
        static_cast<std::int32_t>(bits >> 23) - 127 + (part > s.threshold[k] ? 1 : 0);
    const std::int32_t level = octave < map.last ? octave : map.last;
    const OnFace on = on_face(s.x[k], s.y[k], s.z[k]);
    place_on(on, static_cast<float>(map.size) / 2 * std::bit_cast<float>((127 - level) << 23),
             (map.size >> level) + 2, out.at[first + k], out.fx[first + k], out.fy[first + k]);
    out.level[first + k] = level;
    out.weight[first + k] = 1;
  }
}
Dispatched<locate_level_loop> locate_level;

// Looks evenly along the lines, every `step`-th from `first_tap` on, each as wide as the pixel is narrow or as they are apart.
[[gnu::always_inline]] inline void spread_lines_loop(const SampleLines& lines, int first_tap,
                                                     int step, float per_texel, float spacing,
                                                     Spread& out) {
  const SampleLines l = lines;
  const float share = 1 / static_cast<float>(l.taps);
  for (int tap = first_tap, to = 0; tap < l.taps; tap += step, to += l.members) {
    const float along = (static_cast<float>(tap) + 0.5f) * share - 0.5f;
    // Multiples of the golden ratio are spread evenly, however many are taken.
    const double turns = (tap + 0.5) * (std::numbers::phi - 1);
    const auto threshold = static_cast<float>(turns - static_cast<int>(turns));
    for (int k = 0; k < l.members; ++k) {
      out.x[to + k] = l.x[k] + l.ax[k] * along;
      out.y[to + k] = l.y[k] + l.ay[k] * along;
      out.z[to + k] = l.z[k] + l.az[k] * along;
      const float each = l.wide[k] * (share / spacing);
      const float texels = (l.narrow[k] > each ? l.narrow[k] : each) * per_texel;
      out.texels[to + k] = texels > 1 ? texels : 1;
      out.threshold[to + k] = threshold;
    }
  }
}
Dispatched<spread_lines_loop> spread_lines;

[[gnu::always_inline]] inline void spread_points_loop(const SampleLines& lines, float per_texel,
                                                      Spread& out) {
  const SampleLines l = lines;
  for (int k = 0; k < l.members; ++k) {
    out.x[k] = l.x[k], out.y[k] = l.y[k], out.z[k] = l.z[k];
    const float texels = l.wide[k] * per_texel;
    out.texels[k] = texels > 1 ? texels : 1;
  }
}
Dispatched<spread_points_loop> spread_points;

[[gnu::always_inline]] inline const SkyTexel* texel(const TexelLevels& levels,
                                                    const TexelIndices& of, int k) {
  return levels.texels[of.level[k]] + of.at[k];
}

[[gnu::always_inline]] inline int side(const TexelLevels& levels, const TexelIndices& of, int k) {
  return levels.side[of.level[k]];
}

template <bool kWide>
[[gnu::always_inline]] inline void take_any_loop(const TexelLevels& levels, const TexelIndices& a,
                                                 const TexelIndices& b, const std::uint16_t* who,
                                                 int count, Pair* sums) {
  for (int k = 0; k < count; ++k) {
    const int later = std::min(k + kAhead, count - 1);
    prefetch(texel(levels, a, later), side(levels, a, later)),
        prefetch(texel(levels, b, later), side(levels, b, later));
    Pair light;
    sample_pair<kWide>({texel(levels, a, k), side(levels, a, k), a.fx[k], a.fy[k], a.weight[k]},
                       {texel(levels, b, k), side(levels, b, k), b.fx[k], b.fy[k], b.weight[k]},
                       light);
    sums[who[k]] += light;
  }
}
Dispatched<take_any_loop<true>> take_any;
Dispatched<take_any_loop<false>> take_any_narrowly;

template <bool kWide>
[[gnu::always_inline]] inline void take_finest_loop(const SkyTexel* texels, int side,
                                                    const TexelIndices& a, const TexelIndices& b,
                                                    const std::uint16_t* who, int count,
                                                    Pair* sums) {
  for (int k = 0; k < count; ++k) {
    const int later = std::min(k + kAhead, count - 1);
    prefetch(texels + a.at[later], side), prefetch(texels + b.at[later], side);
    Pair light;
    sample_pair<kWide>({texels + a.at[k], side, a.fx[k], a.fy[k], 1},
                       {texels + b.at[k], side, b.fx[k], b.fy[k], 1}, light);
    sums[who[k]] += light;
  }
}
Dispatched<take_finest_loop<true>> take_finest;
Dispatched<take_finest_loop<false>> take_finest_narrowly;

}  // namespace

TexelQueue::TexelQueue(const SkyMap& map, double spacing)
    : levels_(levels_of(map)),
      size_(map.levels().front().size),
      last_(static_cast<int>(map.levels().size()) - 1),
      per_texel_(static_cast<float>(size_ * 2 / std::numbers::pi)),
      spacing_(static_cast<float>(spacing)) {}

// Looks of a pixel are taken in pairs: on two levels, or one after another in its line.
void TexelQueue::locate(const SampleLines& lines, Queue& queue) const {
  const Map map{size_, last_};
  const bool two_levels = on_two_levels(lines.taps, lines.minified);
  const int count = pairs(lines.taps, lines.minified) * lines.members, first = queue.count;
  Spread spread;
  for (int part = 0; part < 2; ++part) {
    TexelIndices& out = queue.spots[static_cast<std::size_t>(part)];
    if (lines.taps == 1)
      spread_points(lines, per_texel_, spread);
    else if (!two_levels)
      spread_lines(lines, part, 2, per_texel_, spacing_, spread);
    else if (part == 0)
      spread_lines(lines, 0, 1, per_texel_, spacing_, spread);
    if (two_levels)
      locate_levels(spread, count, map, part, first, out);
    else if (lines.minified)
      locate_level(spread, count, map, first, out);
    else
      locate_finest(spread, count, map, first, out);
    if (lines.taps > 1 || lines.minified) continue;
    std::fill_n(&out.level[first], count, 0);
    std::fill_n(&out.weight[first], count, part == 0 ? 1.0f : 0.0f);  // the only one, twice
  }
}

void TexelQueue::add(const SampleLines& lines, Pair* sums) {
  if (std::max(finest_.count, any_.count) + kAtOnce > kMost) take(sums);
  Queue& queue = lines.minified || lines.taps == 1 ? any_ : finest_;
  locate(lines, queue);
  for (int k = 0; k < pairs(lines.taps, lines.minified); ++k, queue.count += lines.members)
    std::copy_n(lines.who, lines.members, &queue.who[queue.count]);
}

void TexelQueue::take(Pair* sums) {
  const bool wide = simd_in_use() != Simd::kPortable;
  const auto take_queue = [&](const auto& loop, const Queue& queue, const auto&... of) {
    loop(of..., queue.spots[0], queue.spots[1], queue.who.data(), queue.count, sums);
  };
  const SkyTexel* texels = levels_.texels[0];
  const int side = levels_.side[0];
  if (wide) {
    take_queue(take_any, any_, levels_);
    take_queue(take_finest, finest_, texels, side);
  } else {
    take_queue(take_any_narrowly, any_, levels_);
    take_queue(take_finest_narrowly, finest_, texels, side);
  }
  any_.count = finest_.count = 0;
}

}  // namespace domefall
