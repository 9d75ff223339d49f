// One tap of a sky map: the light between the four texels about a direction, weighted bilinearly.
// A sample of the map is the mean of one or more taps (SkySampler).  Everything here is inlined
// into dispatched loops, and has no branch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// The four channels of a texel.
using Channels __attribute__((vector_size(16))) = float;
// The channels of two taps in one register, or in two where registers are narrower.
using ChannelPair __attribute__((vector_size(32))) = float;

// A map's levels from the finest on.  The coarsest is repeated up to the end.
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

// cube_face.h explains this mapping; here it is in single precision.
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

// Sets the index of the first of the four texels about a point, and how far the point lies from the
// first towards the others (0 to 1).  Texel i of n has its centre at u = (2 i + 1)/n - 1, so a
// point lies (u + 1) n/2 - 1/2 texels from the first centre; the border adds one texel.
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

// Asks for the four texels from `first` on, each of which may lie in a cache line of its own.
[[gnu::always_inline]] inline void prefetch_texels(const SkyTexel* first, int stride) {
  __builtin_prefetch(first);
  __builtin_prefetch(first + 1);
  __builtin_prefetch(first + stride);
  __builtin_prefetch(first + stride + 1);
}

// The bits of a half float, shifted left by 13, are those of a float whose exponent is 127 - 15 =
// 112 too small.  Taps therefore give 2^-112 of their light, and the sum of a sample's taps is
// multiplied by this once.
inline constexpr float kTapScale = 0x1p112f;

// Turns halves, each in the lower part of 32 bits, into floats that are 2^112 times too small.
template <class Bits, class Halves, class Floats>
[[gnu::always_inline]] inline void widen(const Halves& halves, Floats& floats) {
  Bits bits;
  std::memcpy(&bits, &halves, sizeof bits);
  bits <<= 13;
  std::memcpy(&floats, &bits, sizeof floats);
}

// Decodes the texels at t and at u, and the right neighbours of both.
[[gnu::always_inline]] inline void decode(const SkyTexel* t, const SkyTexel* u, ChannelPair& left,
                                          ChannelPair& right) {
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
  widen<Bits>(low, left);
  widen<Bits>(high, right);
}

// Gives the same bits as the function above for one of its two texels.
[[gnu::always_inline]] inline void decode(const SkyTexel* t, Channels& left, Channels& right) {
  using Halves __attribute__((vector_size(16))) = std::uint16_t;
  using Bits __attribute__((vector_size(16))) = std::uint32_t;
  Halves both;
  std::memcpy(&both, t, sizeof both);
  const Halves none{};
  const Halves low = __builtin_shufflevector(both, none, 0, 8, 1, 9, 2, 10, 3, 11);
  const Halves high = __builtin_shufflevector(both, none, 4, 12, 5, 13, 6, 14, 7, 15);
  widen<Bits>(low, left);
  widen<Bits>(high, right);
}

// Fills the channels of the first tap with one number and those of the second with another.
[[gnu::always_inline]] inline void broadcast(float first, float second, ChannelPair& pair) {
  const Channels a{first, first, first, first}, b{second, second, second, second};
  pair = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

// One tap: the first of its four texels, the stride of their level, the part of the way to the
// neighbours, and the factor of its light.
struct WeightedTap {
  const SkyTexel* texel;
  int stride;
  float fx, fy, weight;
};

// Takes both taps at once, without their weights.
[[gnu::always_inline]] inline void bilinear(const WeightedTap& first, const WeightedTap& second,
                                            ChannelPair& out) {
  ChannelPair upper_left, upper_right, lower_left, lower_right, x, y;
  decode(first.texel, second.texel, upper_left, upper_right);
  decode(first.texel + first.stride, second.texel + second.stride, lower_left, lower_right);
  broadcast(first.fx, second.fx, x);
  broadcast(first.fy, second.fy, y);
  const ChannelPair left = upper_left + (lower_left - upper_left) * y;
  const ChannelPair right = upper_right + (lower_right - upper_right) * y;
  out = left + (right - left) * x;
}

// Takes one tap, without its weight, with the same bits.
[[gnu::always_inline]] inline void bilinear(const WeightedTap& tap, Channels& out) {
  Channels upper_left, upper_right, lower_left, lower_right;
  decode(tap.texel, upper_left, upper_right);
  decode(tap.texel + tap.stride, lower_left, lower_right);
  const Channels left = upper_left + (lower_left - upper_left) * tap.fy;
  const Channels right = upper_right + (lower_right - upper_right) * tap.fy;
  out = left + (right - left) * tap.fx;
}

// Takes two taps, each times its weight.  kWide does so in one register, which pays from AVX2 on.
template <bool kWide>
[[gnu::always_inline]] inline void take_pair(const WeightedTap& first, const WeightedTap& second,
                                             ChannelPair& out) {
  if constexpr (kWide) {
    ChannelPair weights;
    broadcast(first.weight, second.weight, weights);
    bilinear(first, second, out);
    out *= weights;
  } else {
    Channels taps[2];
    bilinear(first, taps[0]);
    bilinear(second, taps[1]);
    taps[0] *= first.weight;
    taps[1] *= second.weight;
    std::memcpy(&out, taps, sizeof out);
  }
}

}  // namespace domefall
