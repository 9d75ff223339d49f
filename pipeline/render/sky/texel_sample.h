// Looks between the texels of a sky map, for the loops of SkySampler: where on the map a direction falls,
// and the light between the four texels there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// Four channels in a register.
using Four __attribute__((vector_size(16))) = float;

// A map's levels, from the finest on; beyond the last they are repeated.
struct TexelLevels {
  static constexpr int kMost = 16;
  std::array<const SkyTexel*, kMost> texels;
  std::array<int, kMost> side;
};

inline TexelLevels levels_of(const SkyMap& map) {
  TexelLevels l{};
  const auto& from = map.levels();
  for (std::size_t k = 0; k < TexelLevels::kMost; ++k) {
    const SkyLevel& level = from[std::min(k, from.size() - 1)];
    l.texels[k] = level.texels, l.side[k] = level.size + 2;
  }
  return l;
}

// A texel's place from a direction, without a branch; cube_face.h has it in words.
struct OnFace {
  std::int32_t face;
  float u, v;
};
[[gnu::always_inline]] inline OnFace on_face(float x, float y, float z) {
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const bool is_x = (ax >= ay) & (ax >= az), is_y = !is_x & (ay >= az);
  const float major = is_x ? x : is_y ? y : z;
  const float inverse = 1 / std::abs(major);
  const float u = (is_x ? y : is_y ? z : x) * inverse, v = (is_x ? z : is_y ? x : y) * inverse;
  return {(is_x ? 0 : is_y ? 2 : 4) + (major < 0 ? 1 : 0), u, v};
}

// at: the first of four texels, of a level with `side` texels in a row of its faces, borders included, half
// of whose size is `half_size`; fx, fy: how far between them.
[[gnu::always_inline]] inline void place_on(const OnFace& on, float half_size, std::int32_t side,
                                            std::int32_t& at, float& fx, float& fy) {
  const float x = (on.u + 1) * half_size + 0.5f, y = (on.v + 1) * half_size + 0.5f;
  const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y);
  at = (on.face * side + j) * side + i;
  fx = x - static_cast<float>(i);
  fy = y - static_cast<float>(j);
}

// Asks for four texels that will be wanted, which may lie in four lines of the cache.
[[gnu::always_inline]] inline void prefetch(const SkyTexel* t, int side) {
  __builtin_prefetch(t), __builtin_prefetch(t + 1);
  __builtin_prefetch(t + side), __builtin_prefetch(t + side + 1);
}

// What `bilinear` gives is so many times too small.
inline constexpr float kTexelScale = 0x1p112f;

// Two looks in a register, or what there is of them.
using Pair __attribute__((vector_size(32))) = float;

// A number for each of the two.
[[gnu::always_inline]] inline void each_of(float first, float second, Pair& pair) {
  const Four a{first, first, first, first}, b{second, second, second, second};
  pair = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

// Floats from halves that stand in the lower parts of 32 bits, 2^112 times too small.
template <class Bits, class Halves, class Floats>
[[gnu::always_inline]] inline void widen(const Halves& halves, Floats& floats) {
  Bits bits;
  std::memcpy(&bits, &halves, sizeof bits);
  bits <<= 13;
  std::memcpy(&floats, &bits, sizeof floats);
}

// Two texels side by side at t and at u: the left ones of both, and the right ones.  A half that is not
// subnormal is a float's bits, shifted, and kTexelScale times too small; that is mended once for all looks of
// a pixel.
[[gnu::always_inline]] inline void decode(const SkyTexel* t, const SkyTexel* u, Pair& left,
                                          Pair& right) {
  using Halves __attribute__((vector_size(16))) = std::uint16_t;
  using TwiceHalves __attribute__((vector_size(32))) = std::uint16_t;
  using Bits __attribute__((vector_size(32))) = std::uint32_t;
  Halves a, b;
  std::memcpy(&a, t, sizeof a);
  std::memcpy(&b, u, sizeof b);
  const TwiceHalves both =
      __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const TwiceHalves none{};
  const TwiceHalves low =
      __builtin_shufflevector(both, none, 0, 16, 1, 17, 2, 18, 3, 19, 8, 24, 9, 25, 10, 26, 11, 27);
  const TwiceHalves high = __builtin_shufflevector(both, none, 4, 20, 5, 21, 6, 22, 7, 23, 12, 28,
                                                   13, 29, 14, 30, 15, 31);
  widen<Bits>(low, left), widen<Bits>(high, right);
}

// Two looks between four texels each, the first of which are t and u.
[[gnu::always_inline]] inline void bilinear(const SkyTexel* t, int side_of_t, const SkyTexel* u,
                                            int side_of_u, float fx_of_t, float fx_of_u,
                                            float fy_of_t, float fy_of_u, Pair& out) {
  Pair upper_left, upper_right, lower_left, lower_right, x, y;
  decode(t, u, upper_left, upper_right);
  decode(t + side_of_t, u + side_of_u, lower_left, lower_right);
  each_of(fx_of_t, fx_of_u, x), each_of(fy_of_t, fy_of_u, y);
  const Pair left = upper_left + (lower_left - upper_left) * y;
  const Pair right = upper_right + (lower_right - upper_right) * y;
  out = left + (right - left) * x;
}

// The same of one look, in registers half as wide: the same bits.
[[gnu::always_inline]] inline void decode(const SkyTexel* t, Four& left, Four& right) {
  using Halves __attribute__((vector_size(16))) = std::uint16_t;
  using Bits __attribute__((vector_size(16))) = std::uint32_t;
  Halves both;
  std::memcpy(&both, t, sizeof both);
  const Halves none{};
  const Halves low = __builtin_shufflevector(both, none, 0, 8, 1, 9, 2, 10, 3, 11);
  const Halves high = __builtin_shufflevector(both, none, 4, 12, 5, 13, 6, 14, 7, 15);
  widen<Bits>(low, left), widen<Bits>(high, right);
}

[[gnu::always_inline]] inline void bilinear(const SkyTexel* t, int side, float fx, float fy,
                                            Four& out) {
  Four upper_left, upper_right, lower_left, lower_right;
  decode(t, upper_left, upper_right), decode(t + side, lower_left, lower_right);
  const Four left = upper_left + (lower_left - upper_left) * fy;
  const Four right = upper_right + (lower_right - upper_right) * fy;
  out = left + (right - left) * fx;
}

// Two looks, each times its weight: in one register, which needs AVX2 to pay, or one after the other.
struct WeightedSample {
  const SkyTexel* texel;
  int side;
  float fx, fy, weight;
};
template <bool kWide>
[[gnu::always_inline]] inline void sample_pair(const WeightedSample& first,
                                               const WeightedSample& second, Pair& out) {
  if constexpr (kWide) {
    Pair weights;
    each_of(first.weight, second.weight, weights);
    bilinear(first.texel, first.side, second.texel, second.side, first.fx, second.fx, first.fy,
             second.fy, out);
    out *= weights;
  } else {
    Four halves[2];
    bilinear(first.texel, first.side, first.fx, first.fy, halves[0]);
    bilinear(second.texel, second.side, second.fx, second.fy, halves[1]);
    halves[0] *= first.weight, halves[1] *= second.weight;
    std::memcpy(&out, halves, sizeof out);
  }
}

}  // namespace domefall
