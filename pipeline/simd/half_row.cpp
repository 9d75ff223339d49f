#include "pipeline/simd/half_row.h"

#include <algorithm>
#include <bit>

#include "pipeline/simd/dispatch.h"

namespace domefall {

namespace {

// The largest absolute value, as bits.
[[gnu::always_inline]] inline std::int32_t convert_loop(const float* values, int count,
                                                        std::uint16_t* out) {
  constexpr std::int32_t kExponent = 0x7f800000, kOctave = 1 << 23;
  constexpr std::int32_t kSmallestNormal = (127 - 14) * kOctave;  // 2^-14
  constexpr std::int32_t kLargest = 0x477fe000;                   // 65504
  std::int32_t largest = 0;
  for (int k = 0; k < count; ++k) {
    const auto value = std::bit_cast<std::int32_t>(values[k]);
    const std::int32_t size = value & 0x7fffffff;
    largest = std::max(largest, size);
    // Bits of positive floats are in order; those of negative ones are negative.
    const std::int32_t bounded = std::min(std::max(value, 0), kLargest);
    const auto x = std::bit_cast<float>(bounded);
    const std::int32_t own = bounded & kExponent;
    const std::int32_t octave = std::max(own, kSmallestNormal);
    // Beside 2^13 times its octave a float keeps as many bits as a half has: the addition rounds.
    const std::int32_t beside = octave + 13 * kOctave;
    const std::int32_t bits =
        std::bit_cast<std::int32_t>(x + std::bit_cast<float>(beside)) - beside;
    out[k] = static_cast<std::uint16_t>(bits + ((octave - kSmallestNormal) >> 13));
  }
  return largest;
}
Dispatched<convert_loop> convert;

}  // namespace

bool to_half(const float* values, int count, std::uint16_t* out) {
  constexpr std::int32_t kInfinity = 0x7f800000;
  return convert(values, count, out) < kInfinity;
}

}  // namespace domefall
