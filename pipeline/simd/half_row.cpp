#include "pipeline/simd/half_row.h"

#include <algorithm>
#include <bit>

#include "pipeline/simd/dispatch.h"

namespace domefall {

namespace {

// Converts the floats and returns the bits of the largest absolute value among them.
[[gnu::always_inline]] inline std::int32_t convert_loop(const float* values, int count,
                                                        std::uint16_t* out) {
  constexpr std::int32_t kExponent = 0x7f800000;
  constexpr std::int32_t kOctave = 1 << 23;                       // a step of the exponent by one
  constexpr std::int32_t kSmallestNormal = (127 - 14) * kOctave;  // 2^-14
  constexpr std::int32_t kLargest = 0x477fe000;                   // 65504
  std::int32_t largest = 0;
  for (int k = 0; k < count; ++k) {
    const auto value = std::bit_cast<std::int32_t>(values[k]);
    const std::int32_t size = value & 0x7fffffff;
    largest = std::max(largest, size);
    // The bits of positive floats are ordered as their values are, and as integers those of
    // negative floats are below 0, so that the clamp can be done on integers.
    const std::int32_t bounded = std::min(std::max(value, 0), kLargest);
    const auto x = std::bit_cast<float>(bounded);
    const std::int32_t exponent = bounded & kExponent;
    const std::int32_t octave = std::max(exponent, kSmallestNormal);
    // A float has 13 bits more in its mantissa than a half.  Once 2^13 times its octave is added,
    // those 13 bits no longer fit, so the addition itself rounds to the precision of a half.
    const std::int32_t large = octave + 13 * kOctave;
    const std::int32_t bits = std::bit_cast<std::int32_t>(x + std::bit_cast<float>(large)) - large;
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
