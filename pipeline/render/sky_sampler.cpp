#include "pipeline/render/sky_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/simd.h"
#include "pipeline/render/sky_texels.h"

namespace domefall {
namespace {

constexpr int kChunk = SkyPlaces::kSize;
// From so many looks a pixel on, each keeps to one level of the map.
constexpr int kManyTaps = 4;
// An oblong that is nearly round, or nearly a texel, is blurred to its length.
constexpr float kRound = 1.25f;
// Texels are asked for so many looks ahead.
constexpr int kAhead = 24;

// Between which texels looks fall.
struct Spots {
  alignas(64) std::array<std::int32_t, kChunk> at;
  alignas(64) std::array<float, kChunk> fx, fy;
};
// The same on one or two levels, and the part of the coarser one.
struct LevelSpots {
  Spots fine, coarse;
  alignas(64) std::array<std::int32_t, kChunk> level;
  alignas(64) std::array<float, kChunk> part;
};

// Where `members` pixels look, again and again for each of `taps` places along their lines.
struct Looks {
  int taps, members;
  const float *x, *y, *z;
  const float* blur;       // in radians
  const float* threshold;  // see locate_level
  int count() const { return taps * members; }
};

struct Columns {
  SkyPlaces::Column x, y, z, blur, threshold;
};

[[gnu::always_inline]] inline void locate_loop(const Looks& looks, int size, Spots& spots) {
  const Looks l = looks;
  const float half_size = static_cast<float>(size) / 2;
  for (int k = 0; k < l.count(); ++k) {
    const OnFace on = on_face(l.x[k], l.y[k], l.z[k]);
    place_on(on, half_size, size + 2, spots.at[k], spots.fx[k], spots.fy[k]);
  }
}
Dispatched<locate_loop> locate;

// Levels by the logarithm of the blur in texels, straight between powers of two.
[[gnu::always_inline]] inline void locate_levels_loop(const Looks& looks, float per_texel, int size,
                                                      int last, LevelSpots& spots) {
  const Looks l = looks;
  for (int k = 0; k < l.count(); ++k) {
    const float texels = l.blur[k] * per_texel;
    const float bounded = texels > 1 ? texels : 1;
    const auto bits = std::bit_cast<std::uint32_t>(bounded);
    const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127;
    const std::int32_t fine = octave < last ? octave : last;
    const std::int32_t coarse = fine < last ? fine + 1 : last;
    spots.part[k] = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    spots.level[k] = fine;
    const OnFace on = on_face(l.x[k], l.y[k], l.z[k]);
    const float scale = static_cast<float>(size) / 2;
    place_on(on, scale * std::bit_cast<float>((127 - fine) << 23), (size >> fine) + 2,
             spots.fine.at[k], spots.fine.fx[k], spots.fine.fy[k]);
    place_on(on, scale * std::bit_cast<float>((127 - coarse) << 23), (size >> coarse) + 2,
             spots.coarse.at[k], spots.coarse.fx[k], spots.coarse.fy[k]);
  }
}
Dispatched<locate_levels_loop> locate_levels;

// As locate_levels, for one of many looks of a pixel: each keeps to one level, and as many of them to the
// coarser one as its part asks for.  The threshold is in (0, 1), another one for each look.
[[gnu::always_inline]] inline void locate_level_loop(const Looks& looks, float per_texel, int size,
                                                     int last, LevelSpots& spots) {
  const Looks l = looks;
  for (int k = 0; k < l.count(); ++k) {
    const float texels = l.blur[k] * per_texel;
    const float bounded = texels > 1 ? texels : 1;
    const auto bits = std::bit_cast<std::uint32_t>(bounded);
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const std::int32_t octave =
        static_cast<std::int32_t>(bits >> 23) - 127 + (part > l.threshold[k] ? 1 : 0);
    const std::int32_t level = octave < last ? octave : last;
    spots.level[k] = level;
    const OnFace on = on_face(l.x[k], l.y[k], l.z[k]);
    place_on(on, static_cast<float>(size) / 2 * std::bit_cast<float>((127 - level) << 23),
             (size >> level) + 2, spots.fine.at[k], spots.fine.fx[k], spots.fine.fy[k]);
  }
}
Dispatched<locate_level_loop> locate_level;

[[gnu::always_inline]] inline void add_fine_loop(const TexelLevels& levels, const Spots& s,
                                                 const Looks& looks, Four* sum) {
  const SkyTexel* texels = levels.texels[0];
  const int side = levels.side[0], members = looks.members, end = looks.count();
  for (int k = 0; k < end;)
    for (int m = 0; m < members; ++m, ++k) {
      prefetch(texels + s.at[std::min(k + kAhead, end - 1)], side);
      sum[m] += bilinear(texels + s.at[k], side, s.fx[k], s.fy[k]);
    }
}
Dispatched<add_fine_loop> add_fine;

[[gnu::always_inline]] inline void add_level_loop(const TexelLevels& levels, const LevelSpots& s,
                                                  const Looks& looks, Four* sum) {
  const int members = looks.members, end = looks.count();
  for (int k = 0; k < end;)
    for (int m = 0; m < members; ++m, ++k) {
      const int level = s.level[k], later = std::min(k + kAhead, end - 1), then = s.level[later];
      prefetch(levels.texels[then] + s.fine.at[later], levels.side[then]);
      sum[m] += bilinear(levels.texels[level] + s.fine.at[k], levels.side[level], s.fine.fx[k],
                         s.fine.fy[k]);
    }
}
Dispatched<add_level_loop> add_level;

[[gnu::always_inline]] inline void add_levels_loop(const TexelLevels& levels, const LevelSpots& s,
                                                   const Looks& looks, Four* sum) {
  constexpr int kLast = TexelLevels::kMost - 1;
  const int members = looks.members, end = looks.count();
  for (int k = 0; k < end;)
    for (int m = 0; m < members; ++m, ++k) {
      const int fine = s.level[k], coarse = std::min(fine + 1, kLast);
      const int later = std::min(k + kAhead, end - 1), then = s.level[later];
      prefetch(levels.texels[then] + s.fine.at[later], levels.side[then]);
      const int also = std::min(then + 1, kLast);
      prefetch(levels.texels[also] + s.coarse.at[later], levels.side[also]);
      const Four a = bilinear(levels.texels[fine] + s.fine.at[k], levels.side[fine], s.fine.fx[k],
                              s.fine.fy[k]);
      const Four b = bilinear(levels.texels[coarse] + s.coarse.at[k], levels.side[coarse],
                              s.coarse.fx[k], s.coarse.fy[k]);
      sum[m] += a + (b - a) * s.part[k];
    }
}
Dispatched<add_levels_loop> add_levels;

// One look a pixel at the finest level: the bulk of most frames, in one loop.
[[gnu::always_inline]] inline void fine_colours_loop(const TexelLevels& levels, const Spots& s,
                                                     const float* gain, int count, float* rgb) {
  const SkyTexel* texels = levels.texels[0];
  const int side = levels.side[0];
  for (int k = 0; k < count; ++k, rgb += 3) {
    prefetch(texels + s.at[std::min(k + kAhead, count - 1)], side);
    const Four c = bilinear(texels + s.at[k], side, s.fx[k], s.fy[k]) * kTexelScale * gain[k];
    std::memcpy(rgb, &c, sizeof c);  // the fourth is 0, and the next pixel's to overwrite
  }
}
Dispatched<fine_colours_loop> fine_colours;

[[gnu::always_inline]] inline void to_colours_loop(const Four* sum, const float* gain, float share,
                                                   int count, float* rgb) {
  for (int k = 0; k < count; ++k, rgb += 3) {
    const Four c = sum[k] * kTexelScale * (gain[k] * share);
    rgb[0] = c[0], rgb[1] = c[1], rgb[2] = c[2];
  }
}
Dispatched<to_colours_loop> to_colours;

// I and I theta of blackbody light, shifted by `tone` octaves of temperature.
void thermal_to_colours(const Four* sum, const float* gain, const float* tone, float share,
                        int count, float* rgb) {
  static const auto base = static_cast<float>(std::log2(kThermalBase));
  const BlackbodyColours& colours = blackbody_colours();
  for (int k = 0; k < count; ++k, rgb += 3) {
    const Four of = sum[k] * kTexelScale;
    const float light = of[0];
    WorkingRgb c{0, 0, 0};
    if (light > 0) c = colours.per_flux_log2(base + of[1] / light + tone[k]);
    const float f = light * gain[k] * share;
    rgb[0] = c.r * f, rgb[1] = c.g * f, rgb[2] = c.b * f;
  }
}

// The looks of pixels `first` on, evenly along their lines, each as wide as the pixel is narrow or as they
// are apart.
[[gnu::always_inline]] inline void lay_out_loop(const SkyPlaces& p, int first, int taps,
                                                int members, float spacing, Columns& out) {
  const float share = 1 / static_cast<float>(taps);
  for (int tap = 0, to = 0; tap < taps; ++tap, to += members) {
    const float along = (static_cast<float>(tap) + 0.5f) * share - 0.5f;
    // Multiples of the golden ratio are spread evenly, however many are taken.
    const double turns = (tap + 0.5) * (std::numbers::phi - 1);
    const auto threshold = static_cast<float>(turns - static_cast<int>(turns));
    for (int k = 0; k < members; ++k) {
      const int from = first + k;
      out.x[to + k] = p.x[from] + p.ax[from] * along;
      out.y[to + k] = p.y[from] + p.ay[from] * along;
      out.z[to + k] = p.z[from] + p.az[from] * along;
      const float each = p.wide[from] * (share / spacing);
      out.blur[to + k] = p.narrow[from] > each ? p.narrow[from] : each;
      out.threshold[to + k] = threshold;
    }
  }
}
Dispatched<lay_out_loop> lay_out;

struct TapLimits {
  std::array<int, 10> taps;
  std::array<float, 10> longest;  // in units of its width, of a footprint with so many
};

[[gnu::always_inline]] inline void count_taps_loop(const float* wide, const float* narrow,
                                                   int count, float texel, const TapLimits& limits,
                                                   float longest, std::uint8_t* out) {
  const TapLimits l = limits;
  for (int k = 0; k < count; ++k) {
    const float wanted = wide[k] / (narrow[k] > texel ? narrow[k] : texel);
    int taps = 1;
    for (std::size_t j = 1; j < l.taps.size(); ++j)
      taps = wanted > l.longest[j - 1] ? l.taps[j] : taps;
    out[k] = static_cast<std::uint8_t>(wide[k] < longest ? taps : 1);
  }
}
Dispatched<count_taps_loop> count_taps;

TexelLevels levels_of(const SkyMap& map) {
  TexelLevels l{};
  const auto& from = map.levels();
  for (std::size_t k = 0; k < TexelLevels::kMost; ++k) {
    const SkyLevel& level = from[std::min(k, from.size() - 1)];
    l.texels[k] = level.texels, l.side[k] = level.size + 2;
  }
  return l;
}

}  // namespace

SkySampler::SkySampler(const SkyMap& map)
    : map_(map), texel_(std::numbers::pi / 2 / map.levels().front().size) {}

int SkySampler::taps(double wide, double narrow, int most) const {
  const double wanted = wide / std::max(narrow, texel_);
  if (!(wanted > kRound)) return 1;
  for (const int taps : kTaps)
    if (taps > 1 && (taps * kSpacing >= wanted || taps >= most)) return taps;
  return kMostTaps;
}

void SkySampler::taps(const SkyPlaces& places, int first, int count, int most, float longest,
                      std::uint8_t* out) const {
  TapLimits limits{};
  for (std::size_t j = 0; j < kTaps.size(); ++j) {
    limits.taps[j] = kTaps[j];
    limits.longest[j] = j == 0 ? kRound : static_cast<float>(kTaps[j] * kSpacing);
    if (kTaps[j] >= most) limits.longest[j] = HUGE_VALF;
  }
  count_taps(&places.wide[first], &places.narrow[first], count, static_cast<float>(texel_), limits,
             longest, out);
}

void SkySampler::sample(const SkyPlaces& places, int count, int taps, bool minified,
                        float* rgb) const {
  const TexelLevels levels = levels_of(map_);
  const int size = map_.levels().front().size, last = static_cast<int>(map_.levels().size()) - 1;
  const bool thermal = map_.kind() == SkyMapKind::kThermal;
  const Looks single{
      1, count, places.x.data(), places.y.data(), places.z.data(), places.wide.data(), nullptr};
  if (taps == 1 && !minified && !thermal) {
    Spots spots;
    locate(single, size, spots);
    fine_colours(levels, spots, places.gain.data(), count, rgb);
    return;
  }
  alignas(64) std::array<Four, kChunk> sum;
  std::fill_n(sum.begin(), count, Four{0, 0, 0, 0});
  const auto per_texel = static_cast<float>(1 / texel_);
  Columns columns;
  LevelSpots spots;
  const int at_once = kChunk / taps;
  for (int first = 0; first < count; first += at_once) {
    const int members = std::min(at_once, count - first);
    Looks looks = single;
    if (taps > 1) {
      lay_out(places, first, taps, members, static_cast<float>(kSpacing), columns);
      looks = {taps,
               members,
               columns.x.data(),
               columns.y.data(),
               columns.z.data(),
               columns.blur.data(),
               columns.threshold.data()};
    }
    if (minified && taps >= kManyTaps) {
      locate_level(looks, per_texel, size, last, spots);
      add_level(levels, spots, looks, &sum[first]);
    } else if (minified) {
      locate_levels(looks, per_texel, size, last, spots);
      add_levels(levels, spots, looks, &sum[first]);
    } else {
      locate(looks, size, spots.fine);
      add_fine(levels, spots.fine, looks, &sum[first]);
    }
  }
  const auto share = 1 / static_cast<float>(taps);
  if (thermal)
    thermal_to_colours(sum.data(), places.gain.data(), places.tone.data(), share, count, rgb);
  else
    to_colours(sum.data(), places.gain.data(), share, count, rgb);
}

}  // namespace domefall
