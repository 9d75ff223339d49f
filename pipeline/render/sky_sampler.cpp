#include "pipeline/render/sky_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/render/simd.h"

namespace domefall {
namespace {

constexpr int kMostLevels = 16;
constexpr int kChunk = SkyPlaces::kSize;
// From so many looks a pixel on, each keeps to one level of the map.
constexpr int kManyTaps = 4;

// Four channels in a register.
using Four __attribute__((vector_size(16))) = float;
// Two texels side by side.
using Pair __attribute__((vector_size(32))) = float;
using PairBits __attribute__((vector_size(32))) = std::uint32_t;
using PairHalves __attribute__((vector_size(16))) = std::uint16_t;

struct Levels {
  std::array<const SkyTexel*, kMostLevels> texels;
  std::array<int, kMostLevels> side;
};

// Between which texels a look falls.
struct Spots {
  alignas(64) std::array<std::int32_t, kChunk> at;
  alignas(64) std::array<float, kChunk> fx, fy;
};
// The same on two levels, and the part of the coarser one.
struct LevelSpots {
  Spots fine, coarse;
  alignas(64) std::array<std::int32_t, kChunk> level;
  alignas(64) std::array<float, kChunk> part;
};

struct Directions {
  const float *x, *y, *z;
};

// A texel's place from a direction, without a branch; cube_face.h has it in words.
struct OnFace {
  std::int32_t face;
  float u, v;
};
inline OnFace on_face(float x, float y, float z) {
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const bool is_x = (ax >= ay) & (ax >= az), is_y = !is_x & (ay >= az);
  const float major = is_x ? x : is_y ? y : z;
  const float inverse = 1 / std::abs(major);
  const float u = (is_x ? y : is_y ? z : x) * inverse, v = (is_x ? z : is_y ? x : y) * inverse;
  return {(is_x ? 0 : is_y ? 2 : 4) + (major < 0 ? 1 : 0), u, v};
}

inline void place(const OnFace& on, float half_size, std::int32_t side, std::int32_t& at, float& fx,
                  float& fy) {
  const float x = (on.u + 1) * half_size + 0.5f, y = (on.v + 1) * half_size + 0.5f;
  const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y);
  at = (on.face * side + j) * side + i;
  fx = x - static_cast<float>(i);
  fy = y - static_cast<float>(j);
}

[[gnu::always_inline]] inline void locate_loop(Directions d, int count, int size, Spots& spots) {
  const float half_size = static_cast<float>(size) / 2;
  for (int k = 0; k < count; ++k) {
    const OnFace on = on_face(d.x[k], d.y[k], d.z[k]);
    place(on, half_size, size + 2, spots.at[k], spots.fx[k], spots.fy[k]);
  }
}
Dispatched<locate_loop> locate;

// Levels by the logarithm of the blur in texels, straight between powers of two.
[[gnu::always_inline]] inline void locate_levels_loop(Directions d, const float* blur,
                                                      float per_texel, int count, int size,
                                                      int last, LevelSpots& spots) {
  for (int k = 0; k < count; ++k) {
    const float texels = blur[k] * per_texel;
    const float bounded = texels > 1 ? texels : 1;
    const auto bits = std::bit_cast<std::uint32_t>(bounded);
    const std::int32_t octave = static_cast<std::int32_t>(bits >> 23) - 127;
    const std::int32_t fine = octave < last ? octave : last;
    const std::int32_t coarse = fine < last ? fine + 1 : last;
    spots.part[k] = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    spots.level[k] = fine;
    const OnFace on = on_face(d.x[k], d.y[k], d.z[k]);
    const float scale = static_cast<float>(size) / 2;
    place(on, scale * std::bit_cast<float>((127 - fine) << 23), (size >> fine) + 2,
          spots.fine.at[k], spots.fine.fx[k], spots.fine.fy[k]);
    place(on, scale * std::bit_cast<float>((127 - coarse) << 23), (size >> coarse) + 2,
          spots.coarse.at[k], spots.coarse.fx[k], spots.coarse.fy[k]);
  }
}
Dispatched<locate_levels_loop> locate_levels;

// Texels that a look will want are asked for so many pixels ahead: they are all over the map.
constexpr int kAhead = 12;

inline void prefetch(const SkyTexel* t, int side) {
  __builtin_prefetch(t);
  __builtin_prefetch(t + side);
}

// Between four texels: two rows of two neighbours, each pair in one register.  A half that is not
// subnormal is a float's bits, shifted, and 2^112 times too small.
[[gnu::always_inline]] inline Four bilinear(const SkyTexel* t, int side, float fx, float fy) {
  PairHalves upper, lower;
  std::memcpy(&upper, t, sizeof upper);
  std::memcpy(&lower, t + side, sizeof lower);
  const PairBits upper_bits = __builtin_convertvector(upper, PairBits) << 13;
  const PairBits lower_bits = __builtin_convertvector(lower, PairBits) << 13;
  Pair above, below;
  std::memcpy(&above, &upper_bits, sizeof above);
  std::memcpy(&below, &lower_bits, sizeof below);
  const Pair both = (above + (below - above) * fy) * 0x1p112f;
  const Four left = __builtin_shufflevector(both, both, 0, 1, 2, 3);
  const Four right = __builtin_shufflevector(both, both, 4, 5, 6, 7);
  return left + (right - left) * fx;
}

[[gnu::always_inline]] inline void add_fine_loop(const Levels& levels, const Spots& s, int count,
                                                 Four* sum) {
  const SkyTexel* texels = levels.texels[0];
  const int side = levels.side[0];
  for (int k = 0; k < count; ++k) {
    prefetch(texels + s.at[std::min(k + kAhead, count - 1)], side);
    sum[k] += bilinear(texels + s.at[k], side, s.fx[k], s.fy[k]);
  }
}
Dispatched<add_fine_loop> add_fine;

// As add_levels, for one of many looks of a pixel: each keeps to one level, and as many of them to the
// coarser one as its part asks for.  `threshold`: in (0, 1), another one for each look.
[[gnu::always_inline]] inline void locate_level_loop(Directions d, const float* blur,
                                                     float per_texel, float threshold, int count,
                                                     int size, int last, LevelSpots& spots) {
  for (int k = 0; k < count; ++k) {
    const float texels = blur[k] * per_texel;
    const float bounded = texels > 1 ? texels : 1;
    const auto bits = std::bit_cast<std::uint32_t>(bounded);
    const float part = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1;
    const std::int32_t octave =
        static_cast<std::int32_t>(bits >> 23) - 127 + (part > threshold ? 1 : 0);
    const std::int32_t level = octave < last ? octave : last;
    spots.level[k] = level;
    const OnFace on = on_face(d.x[k], d.y[k], d.z[k]);
    place(on, static_cast<float>(size) / 2 * std::bit_cast<float>((127 - level) << 23),
          (size >> level) + 2, spots.fine.at[k], spots.fine.fx[k], spots.fine.fy[k]);
  }
}
Dispatched<locate_level_loop> locate_level;

[[gnu::always_inline]] inline void add_level_loop(const Levels& levels, const LevelSpots& s,
                                                  int count, Four* sum) {
  for (int k = 0; k < count; ++k) {
    const int level = s.level[k], later = std::min(k + kAhead, count - 1), then = s.level[later];
    prefetch(levels.texels[then] + s.fine.at[later], levels.side[then]);
    sum[k] += bilinear(levels.texels[level] + s.fine.at[k], levels.side[level], s.fine.fx[k],
                       s.fine.fy[k]);
  }
}
Dispatched<add_level_loop> add_level;

[[gnu::always_inline]] inline void add_levels_loop(const Levels& levels, const LevelSpots& s,
                                                   int count, Four* sum) {
  const int last = static_cast<int>(levels.texels.size()) - 1;
  for (int k = 0; k < count; ++k) {
    const int fine = s.level[k], coarse = fine < last ? fine + 1 : last;
    const int later = std::min(k + kAhead, count - 1), then = s.level[later];
    prefetch(levels.texels[then] + s.fine.at[later], levels.side[then]);
    const Four a =
        bilinear(levels.texels[fine] + s.fine.at[k], levels.side[fine], s.fine.fx[k], s.fine.fy[k]);
    const Four b = bilinear(levels.texels[coarse] + s.coarse.at[k], levels.side[coarse],
                            s.coarse.fx[k], s.coarse.fy[k]);
    sum[k] += a + (b - a) * s.part[k];
  }
}
Dispatched<add_levels_loop> add_levels;

// One look a pixel at the finest level: the bulk of most frames, in one loop.
[[gnu::always_inline]] inline void fine_colours_loop(const Levels& levels, const Spots& s,
                                                     const float* gain, int count, float* rgb) {
  const SkyTexel* texels = levels.texels[0];
  const int side = levels.side[0];
  for (int k = 0; k < count; ++k, rgb += 3) {
    prefetch(texels + s.at[std::min(k + kAhead, count - 1)], side);
    const Four c = bilinear(texels + s.at[k], side, s.fx[k], s.fy[k]) * gain[k];
    std::memcpy(rgb, &c, sizeof c);  // the fourth is 0, and the next pixel's to overwrite
  }
}
Dispatched<fine_colours_loop> fine_colours;

[[gnu::always_inline]] inline void to_colours_loop(const Four* sum, const float* gain, float share,
                                                   int count, float* rgb) {
  for (int k = 0; k < count; ++k, rgb += 3) {
    const Four c = sum[k] * (gain[k] * share);
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
    const float light = sum[k][0];
    WorkingRgb c{0, 0, 0};
    if (light > 0) c = colours.per_flux_log2(base + sum[k][1] / light + tone[k]);
    const float f = light * gain[k] * share;
    rgb[0] = c.r * f, rgb[1] = c.g * f, rgb[2] = c.b * f;
  }
}

[[gnu::always_inline]] inline void step_along_loop(const SkyPlaces& p, float along, int count,
                                                   float* x, float* y, float* z) {
  for (int k = 0; k < count; ++k) {
    x[k] = p.x[k] + p.ax[k] * along;
    y[k] = p.y[k] + p.ay[k] * along;
    z[k] = p.z[k] + p.az[k] * along;
  }
}
Dispatched<step_along_loop> step_along;

[[gnu::always_inline]] inline void look_widths_loop(const SkyPlaces& p, float share, int count,
                                                    float* blur) {
  for (int k = 0; k < count; ++k) {
    const float each = p.wide[k] * share;
    blur[k] = p.narrow[k] > each ? p.narrow[k] : each;
  }
}
Dispatched<look_widths_loop> look_widths;

Levels levels_of(const SkyMap& map) {
  Levels l{};
  const auto& from = map.levels();
  for (std::size_t k = 0; k < kMostLevels; ++k) {
    const SkyLevel& level = from[std::min(k, from.size() - 1)];
    l.texels[k] = level.texels, l.side[k] = level.size + 2;
  }
  return l;
}

}  // namespace

SkySampler::SkySampler(const SkyMap& map)
    : map_(map), texel_(std::numbers::pi / 2 / map.levels().front().size) {}

int SkySampler::taps(double wide, double narrow, int most) const {
  // An oblong that is nearly round, or nearly a texel, is blurred to its length.
  constexpr double kRound = 1.25;
  const double wanted = wide / std::max(narrow, texel_);
  if (!(wanted > kRound)) return 1;
  static constexpr std::array<int, 9> kTaps{2, 3, 4, 6, 8, 12, 16, 24, kMostTaps};
  for (const int taps : kTaps)
    if (taps * kSpacing >= wanted || taps >= most) return taps;
  return kMostTaps;
}

void SkySampler::sample(const SkyPlaces& places, int count, int taps, bool minified,
                        float* rgb) const {
  const Levels levels = levels_of(map_);
  const int size = map_.levels().front().size, last = static_cast<int>(map_.levels().size()) - 1;
  const bool thermal = map_.kind() == SkyMapKind::kThermal;
  const auto share = 1 / static_cast<float>(taps);
  if (taps == 1 && !minified && !thermal) {
    Spots spots;
    locate({places.x.data(), places.y.data(), places.z.data()}, count, size, spots);
    fine_colours(levels, spots, places.gain.data(), count, rgb);
    return;
  }
  alignas(64) std::array<Four, kChunk> sum;
  std::fill_n(sum.begin(), count, Four{0, 0, 0, 0});
  SkyPlaces::Column x, y, z, blur;
  if (minified && taps == 1) std::copy_n(places.wide.begin(), count, blur.begin());
  if (minified && taps > 1)
    look_widths(places, share / static_cast<float>(kSpacing), count, blur.data());
  const auto per_texel = static_cast<float>(1 / texel_);
  for (int tap = 0; tap < taps; ++tap) {
    Directions d{places.x.data(), places.y.data(), places.z.data()};
    if (taps > 1) {
      step_along(places, (static_cast<float>(tap) + 0.5f) * share - 0.5f, count, x.data(), y.data(),
                 z.data());
      d = {x.data(), y.data(), z.data()};
    }
    if (minified && taps >= kManyTaps) {
      LevelSpots spots;
      // Multiples of the golden ratio are spread evenly, however many are taken.
      const double turns = (tap + 0.5) * (std::numbers::phi - 1);
      locate_level(d, blur.data(), per_texel, static_cast<float>(turns - std::floor(turns)), count,
                   size, last, spots);
      add_level(levels, spots, count, sum.data());
    } else if (minified) {
      LevelSpots spots;
      locate_levels(d, blur.data(), per_texel, count, size, last, spots);
      add_levels(levels, spots, count, sum.data());
    } else {
      Spots spots;
      locate(d, count, size, spots);
      add_fine(levels, spots, count, sum.data());
    }
  }
  if (thermal)
    thermal_to_colours(sum.data(), places.gain.data(), places.tone.data(), share, count, rgb);
  else
    to_colours(sum.data(), places.gain.data(), share, count, rgb);
}

}  // namespace domefall
