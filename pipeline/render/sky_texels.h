// Looks between the texels of a sky map, for the loops of SkySampler: where on the map a direction falls,
// and the light between the four texels there.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/sky/sky_map.h"

namespace domefall {

// Four channels in a register.
using Four __attribute__((vector_size(16))) = float;

// A map's levels, from the finest on; beyond the last they are repeated.
struct TexelLevels {
  static constexpr int kMost = 16;
  std::array<const SkyTexel*, kMost> texels;
  std::array<int, kMost> side;
};

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

// Asks for four texels that will be wanted: they are all over the map.
[[gnu::always_inline]] inline void prefetch(const SkyTexel* t, int side) {
  __builtin_prefetch(t);
  __builtin_prefetch(t + side);
}

// What `bilinear` gives is so many times too small.
inline constexpr float kTexelScale = 0x1p112f;

// Between four texels: two rows of two neighbours, each pair in one register.  A half that is not subnormal
// is a float's bits, shifted, and kTexelScale times too small; that is mended once for all looks of a pixel.
[[gnu::always_inline]] inline Four bilinear(const SkyTexel* t, int side, float fx, float fy) {
  using Pair __attribute__((vector_size(32))) = float;
  using PairBits __attribute__((vector_size(32))) = std::uint32_t;
  using PairHalves __attribute__((vector_size(16))) = std::uint16_t;
  PairHalves upper, lower;
  std::memcpy(&upper, t, sizeof upper);
  std::memcpy(&lower, t + side, sizeof lower);
  const PairBits upper_bits = __builtin_convertvector(upper, PairBits) << 13;
  const PairBits lower_bits = __builtin_convertvector(lower, PairBits) << 13;
  Pair above, below;
  std::memcpy(&above, &upper_bits, sizeof above);
  std::memcpy(&below, &lower_bits, sizeof below);
  const Pair both = above + (below - above) * fy;
  const Four left = __builtin_shufflevector(both, both, 0, 1, 2, 3);
  const Four right = __builtin_shufflevector(both, both, 4, 5, 6, 7);
  return left + (right - left) * fx;
}

}  // namespace domefall
