#include "pipeline/grade/pixel_planes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

using Halves __attribute__((vector_size(2 * kLanes))) = std::uint16_t;
using HalfBits __attribute__((vector_size(4 * kLanes))) = std::int32_t;

constexpr int kGroup = kLanes;  // pixels

// Shifted, a half's bits are those of a float that is 2^112 times too small.
[[gnu::always_inline]] inline void store_plane(const HalfBits& bits, const HalfBits& bad,
                                               float* out) {
  const HalfBits shifted = bits << 13;
  Lanes values;
  std::memcpy(&values, &shifted, sizeof values);
  const Lanes scaled = values * 0x1p112f;
  const Lanes kept = bad ? Lanes{} - 1 : scaled;
  std::memcpy(out, &kept, sizeof kept);
}

// Splits so many groups of 8 pixels, and returns how many of the pixels are black.
[[gnu::always_inline]] inline int split_loop(const std::uint16_t* rgb, int groups, float* red,
                                             float* green, float* blue) {
  constexpr int kInfinityBits = 0x7c00;
  HalfBits blacks{};
  for (int k = 0; k < groups; ++k, rgb += 3 * kGroup) {
    Halves a, b, c;
    std::memcpy(&a, rgb, sizeof a);
    std::memcpy(&b, rgb + kGroup, sizeof b);
    std::memcpy(&c, rgb + 2 * kGroup, sizeof c);
    const Halves ra = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
    const Halves ga = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
    const Halves ba = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
    const Halves rh = __builtin_shufflevector(ra, c, 0, 1, 2, 3, 4, 5, 10, 13);
    const Halves gh = __builtin_shufflevector(ga, c, 0, 1, 2, 3, 4, 8, 11, 14);
    const Halves bh = __builtin_shufflevector(ba, c, 0, 1, 2, 3, 4, 9, 12, 15);
    const HalfBits r = __builtin_convertvector(rh, HalfBits);
    const HalfBits g = __builtin_convertvector(gh, HalfBits);
    const HalfBits e = __builtin_convertvector(bh, HalfBits);
    const HalfBits bad = (r >= kInfinityBits) | (g >= kInfinityBits) | (e >= kInfinityBits);
    blacks -= (r | g | e) == 0;
    store_plane(r, bad, red + kGroup * k);
    store_plane(g, bad, green + kGroup * k);
    store_plane(e, bad, blue + kGroup * k);
  }
  int sum = 0;
  for (int k = 0; k < kLanes; ++k) sum += blacks[k];
  return sum;
}
Dispatched<split_loop> split;

}  // namespace

int split_pixels(const Imath::half* rgb, int count, PixelPlanes& planes) {
  static_assert(sizeof(Imath::half) == sizeof(std::uint16_t));
  const auto* bits = reinterpret_cast<const std::uint16_t*>(rgb);
  const int groups = count / kGroup, whole = groups * kGroup, rest = count - whole;
  int blacks = split(bits, groups, planes.red.data(), planes.green.data(), planes.blue.data());
  if (rest == 0) return blacks;
  std::uint16_t last[3 * kGroup];
  std::fill(std::begin(last), std::end(last), std::uint16_t{1});
  std::copy_n(bits + 3 * whole, 3 * rest, last);
  blacks += split(last, 1, &planes.red[whole], &planes.green[whole], &planes.blue[whole]);
  return blacks;
}

}  // namespace domefall
