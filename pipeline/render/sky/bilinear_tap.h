// A tap of a sky map is the light of the four texels around a direction, weighted bilinearly.  A
// sample of the map is the mean of one or more taps (SkySampler).  All functions here are inlined
// into dispatched loops and have no branches.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/sources/sky/sky_map.h"

namespace domefall {

// Channels are the four channels of a texel.
using Channels __attribute__((vector_size(16))) = float;
// A ChannelPair holds the channels of two texels in one register, or in two where registers are
// narrower.
using ChannelPair __attribute__((vector_size(32))) = float;

// MipLevels lists a map's levels, beginning with the finest.  The coarsest is repeated up to the
// end.
struct MipLevels {
  static constexpr int kMost = 16;
  std::array<const SkyTexel*, kMost> texels;
  std::array<int, kMost> stride;  // texels from one row of a face to the next, borders included
};

inline MipLevels mip_levels(const SkyMap& map) {
  MipLevels mip{};
  const auto& levels = map.levels();
  for (std::size_t k = 0; k < MipLevels::kMost; ++k) {
    const SkyLevel& level = levels[std::min(k, levels.size() - 1)];
    mip.texels[k] = level.texels;
    mip.stride[k] = level.size + 2;
  }
  return mip;
}

// This is the mapping of cube_face.h in single precision.
struct FloatFacePoint {
  std::int32_t face;
  float u, v;
};
[[gnu::always_inline]] inline FloatFacePoint float_face_of(float x, float y, float z) {
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  const bool is_x = (ax >= ay) & (ax >= az), is_y = !is_x & (ay >= az);
  const float major = is_x ? x : is_y ? y : z;
  const float inverse = 1 / std::abs(major);
  const float u = (is_x ? y : is_y ? z : x) * inverse, v = (is_x ? z : is_y ? x : y) * inverse;
  return {(is_x ? 0 : is_y ? 2 : 4) + (major < 0 ? 1 : 0), u, v};
}

// Sets the index of the first of the four texels around a point, and how far the point lies from
// the first towards the others (0 to 1).  Texel i of n has its centre at u = (2 i + 1)/n - 1, so a
// point lies (u + 1) n/2 - 1/2 texels from the first centre.  The border adds one texel.
// `half_size` is n/2.
[[gnu::always_inline]] inline void locate_texels(const FloatFacePoint& point, float half_size,
                                                 std::int32_t stride, std::int32_t& first,
                                                 float& fx, float& fy) {
  const float x = (point.u + 1) * half_size + 0.5f, y = (point.v + 1) * half_size + 0.5f;
  const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y);
  first = (point.face * stride + j) * stride + i;
  fx = x - static_cast<float>(i);
  fy = y - static_cast<float>(j);
}

// TexelWeights are the weights of the four texels around a point: the first one, its right
// neighbour in the row, and the same two in the next row.  All of them contain a common factor.
struct TexelWeights {
  float channel[4];
};

// The bits of a half float, shifted left by 13, are those of a float whose exponent is too small by
// the difference of the biases, 127 - 15 = 112.  The weights contain the missing factor.
inline constexpr float kTapScale = 0x1p112f;

// Sets the weights.  `fx` and `fy` are those of locate_texels, and `factor` applies to the light.
[[gnu::always_inline]] inline void weigh_texels(float fx, float fy, float factor,
                                                TexelWeights& weights) {
  const float lower = fy * (factor * kTapScale), upper = (1 - fy) * (factor * kTapScale);
  weights.channel[0] = (1 - fx) * upper;
  weights.channel[1] = fx * upper;
  weights.channel[2] = (1 - fx) * lower;
  weights.channel[3] = fx * lower;
}

// Prefetches the four texels from `first` on.  Each row of them mostly lies in one cache line.
[[gnu::always_inline]] inline void prefetch_texels(const SkyTexel* first, int stride) {
  __builtin_prefetch(first);
  __builtin_prefetch(first + 1);
  __builtin_prefetch(first + stride);
  __builtin_prefetch(first + stride + 1);
}

// Turns two neighbours into floats that are 1/kTapScale of their channels.  A half float is placed
// into the lower half of a zero word, which is shifted left by 13.
[[gnu::always_inline]] inline void decode(const SkyTexel* texels, ChannelPair& both) {
  using Halves __attribute__((vector_size(16))) = std::uint16_t;
  using WideHalves __attribute__((vector_size(32))) = std::uint16_t;
  using Bits __attribute__((vector_size(32))) = std::uint32_t;
  Halves halves;
  std::memcpy(&halves, texels, sizeof halves);
  const Halves none{};
  const WideHalves spread =
      __builtin_shufflevector(halves, none, 0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
  Bits bits;
  std::memcpy(&bits, &spread, sizeof bits);
  bits <<= 13;
  std::memcpy(&both, &bits, sizeof both);
}
[[gnu::always_inline]] inline void decode(const SkyTexel* texels, Channels& left, Channels& right) {
  using Halves __attribute__((vector_size(16))) = std::uint16_t;
  using Bits __attribute__((vector_size(16))) = std::uint32_t;
  Halves halves;
  std::memcpy(&halves, texels, sizeof halves);
  const Halves none{};
  const Halves low = __builtin_shufflevector(halves, none, 0, 8, 1, 9, 2, 10, 3, 11);
  const Halves high = __builtin_shufflevector(halves, none, 4, 12, 5, 13, 6, 14, 7, 15);
  Bits bits[2];
  std::memcpy(&bits[0], &low, sizeof low);
  std::memcpy(&bits[1], &high, sizeof high);
  bits[0] <<= 13;
  bits[1] <<= 13;
  std::memcpy(&left, &bits[0], sizeof left);
  std::memcpy(&right, &bits[1], sizeof right);
}

// Sets the weighted light of the left and of the right texels, whose sum is still to be formed.
// kWide computes in one register, which is faster from AVX2 on.  Both ways give the same bits.
template <bool kWide>
[[gnu::always_inline]] inline void take_texels(const SkyTexel* first, int stride,
                                               const TexelWeights& weights, ChannelPair& light) {
  Channels w;
  std::memcpy(&w, &weights, sizeof w);
  if constexpr (kWide) {
    ChannelPair upper, lower;
    decode(first, upper);
    decode(first + stride, lower);
    light = upper * __builtin_shufflevector(w, w, 0, 0, 0, 0, 1, 1, 1, 1) +
            lower * __builtin_shufflevector(w, w, 2, 2, 2, 2, 3, 3, 3, 3);
  } else {
    Channels upper[2], lower[2];
    decode(first, upper[0], upper[1]);
    decode(first + stride, lower[0], lower[1]);
    const Channels sides[2] = {upper[0] * __builtin_shufflevector(w, w, 0, 0, 0, 0) +
                                   lower[0] * __builtin_shufflevector(w, w, 2, 2, 2, 2),
                               upper[1] * __builtin_shufflevector(w, w, 1, 1, 1, 1) +
                                   lower[1] * __builtin_shufflevector(w, w, 3, 3, 3, 3)};
    std::memcpy(&light, sides, sizeof light);
  }
}

// Adds the light of the left texels to that of the right ones.
[[gnu::always_inline]] inline void total(const ChannelPair& light, Channels& sum) {
  sum = __builtin_shufflevector(light, light, 0, 1, 2, 3) +
        __builtin_shufflevector(light, light, 4, 5, 6, 7);
}

}  // namespace domefall
