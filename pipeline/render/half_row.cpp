#include "pipeline/render/half_row.h"

#include <bit>

#include "pipeline/render/simd.h"

namespace domefall {

namespace {

[[gnu::always_inline]] inline std::uint32_t convert_loop(const float* values, int count,
                                                         std::uint16_t* out) {
  constexpr float kLargest = 65504, kSmallestNormal = 0x1p-14f;
  // Adding it lets the addition round to the step of subnormal halves.
  constexpr float kMagic = 0.5f;
  std::uint32_t not_finite = 0;
  for (int k = 0; k < count; ++k) {
    const float v = values[k];
    not_finite |= (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) == 0x7f800000u ? 1u : 0u;
    const float positive = v > 0 ? v : 0;
    const float x = positive < kLargest ? positive : kLargest;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t normal = (bits + 0xfffu + ((bits >> 13) & 1u) - (112u << 23)) >> 13;
    const std::uint32_t subnormal =
        std::bit_cast<std::uint32_t>(x + kMagic) - std::bit_cast<std::uint32_t>(kMagic);
    out[k] = static_cast<std::uint16_t>(x < kSmallestNormal ? subnormal : normal);
  }
  return not_finite;
}
Dispatched<convert_loop> convert;

}  // namespace

bool to_half(const float* values, int count, std::uint16_t* out) {
  return convert(values, count, out) == 0;
}

}  // namespace domefall
