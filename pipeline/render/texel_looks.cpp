#include "pipeline/render/texel_looks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/render/simd.h"

namespace domefall {
namespace {

// From so many looks a pixel on, each keeps to one level of the map.
constexpr int kManyTaps = 4;
// Texels are asked for so many looks ahead.
constexpr int kAhead = 40;

using Column = std::array<float, TexelLooks::kMostOfLines>;
// Places on the sky and widths (in texels of the finest level) of looks: those of all members, again and
// again for each tap.
struct Spread {
  alignas(64) Column x, y, z, texels, threshold;
};

struct Map {
  int size, last;
};

// Into `out` from element `first` on.
[[gnu::always_inline]] inline void locate_loop(const Spread& __restrict s, int count, Map map,
                                               int first, TexelSpots& __restrict out) {
  const float half_size = static_cast<float>(map.size) / 2;
  for (int k = 0; k < count; ++k) {
    const OnFace on = on_face(s.x[k], s.y[k], s.z[k]);
    place_on(on, half_size, map.size + 2, out.at[first + k], out.fx[first + k], out.fy[first + k]);
    out.level[first + k] = 0;
    out.weight[first + k] = 1;
  }
}
Dispatched<locate_loop> locate;

// Levels by the logarithm of the width in texels, straight between powers of two.  The looks at the coarser
// ones come after those at the finer ones.
[[gnu::always_inline]] inline void locate_levels_loop(const Spread& __restrict s, int count,
                                                      Map map, int first,
                                                      TexelSpots& __restrict out) {
  for (int half = 0; half < 2; ++half, first += count)
    for (int k = 0; k < count; ++k) {
      const auto bits = std::bit_cast<std::uint32_t>(s.texels[k]);
      const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127 + half;
      const std::int32_t level = octave < map.last ? octave : map.last;
      const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
      const OnFace on = on_face(s.x[k], s.y[k], s.z[k]);
      place_on(on, static_cast<float>(map.size) / 2 * std::bit_cast<float>((127 - level) << 23),
               (map.size >> level) + 2, out.at[first + k], out.fx[first + k], out.fy[first + k]);
      out.level[first + k] = level;
      out.weight[first + k] = half == 0 ? 1 - part : part;
    }
}
Dispatched<locate_levels_loop> locate_levels;

// The same for one of many looks of a pixel: each keeps to one level, and as many of them to the coarser one
// as its part asks for.  The threshold is in (0, 1), another one for each look.
[[gnu::always_inline]] inline void locate_level_loop(const Spread& __restrict s, int count, Map map,
                                                     int first, TexelSpots& __restrict out) {
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

// Looks evenly along the lines, each as wide as the pixel is narrow or as they are apart.
[[gnu::always_inline]] inline void spread_lines_loop(const LinesOfLooks& lines, float per_texel,
                                                     float spacing, Spread& out) {
  const LinesOfLooks l = lines;
  const float share = 1 / static_cast<float>(l.taps);
  for (int tap = 0, to = 0; tap < l.taps; ++tap, to += l.members) {
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

[[gnu::always_inline]] inline void spread_points_loop(const LinesOfLooks& lines, float per_texel,
                                                      Spread& out) {
  const LinesOfLooks l = lines;
  for (int k = 0; k < l.members; ++k) {
    out.x[k] = l.x[k], out.y[k] = l.y[k], out.z[k] = l.z[k];
    const float texels = l.wide[k] * per_texel;
    out.texels[k] = texels > 1 ? texels : 1;
  }
}
Dispatched<spread_points_loop> spread_points;

// `count` is even.
[[gnu::always_inline]] inline void take_all_loop(const TexelLevels& levels, const TexelSpots& in,
                                                 const std::uint16_t* who, int count, Four* sums) {
  const auto texel = [&](int k) { return levels.texels[in.level[k]] + in.at[k]; };
  const auto side = [&](int k) { return levels.side[in.level[k]]; };
  for (int k = 0; k < count; k += 2) {
    const int later = std::min(k + kAhead, count - 2);
    prefetch(texel(later), side(later)), prefetch(texel(later + 1), side(later + 1));
    Pair light, weights;
    bilinear(texel(k), side(k), texel(k + 1), side(k + 1), &in.fx[k], &in.fy[k], light);
    each_of(&in.weight[k], weights);
    light *= weights;
    sums[who[k]] += __builtin_shufflevector(light, light, 0, 1, 2, 3);
    sums[who[k + 1]] += __builtin_shufflevector(light, light, 4, 5, 6, 7);
  }
}
Dispatched<take_all_loop> take_all;

}  // namespace

TexelLooks::TexelLooks(const SkyMap& map, double spacing)
    : levels_(levels_of(map)),
      size_(map.levels().front().size),
      last_(static_cast<int>(map.levels().size()) - 1),
      per_texel_(static_cast<float>(size_ * 2 / std::numbers::pi)),
      spacing_(static_cast<float>(spacing)) {}

void TexelLooks::add_members(const LinesOfLooks& lines, int times) {
  for (int k = 0; k < times; ++k, count_ += lines.members)
    std::copy_n(lines.who, lines.members, &who_[count_]);
}

void TexelLooks::add(const LinesOfLooks& lines) {
  Spread spread;
  if (lines.taps == 1)
    spread_points(lines, per_texel_, spread);
  else
    spread_lines(lines, per_texel_, spacing_, spread);
  const int count = lines.taps * lines.members;
  const Map map{size_, last_};
  const bool two_levels = lines.minified && lines.taps < kManyTaps;
  if (!lines.minified)
    locate(spread, count, map, count_, spots_);
  else if (two_levels)
    locate_levels(spread, count, map, count_, spots_);
  else
    locate_level(spread, count, map, count_, spots_);
  add_members(lines, two_levels ? 2 * lines.taps : lines.taps);
}

void TexelLooks::take(Four* sums) {
  if (count_ % 2 != 0) {  // one that adds nothing
    const int k = count_++;
    spots_.at[k] = spots_.level[k] = 0;
    spots_.fx[k] = spots_.fy[k] = spots_.weight[k] = 0;
    who_[k] = who_[0];
  }
  take_all(levels_, spots_, who_.data(), count_, sums);
  count_ = 0;
}

}  // namespace domefall
