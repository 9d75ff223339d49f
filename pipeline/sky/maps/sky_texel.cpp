#include "pipeline/sky/maps/sky_texel.h"

#include <Imath/half.h>

namespace domefall {

std::uint16_t half_bits(float value) {
  constexpr std::uint16_t kSmallestNormal = 0x0400;  // 2^-14
  // Halves of one sign are ordered as their bits are, so that one comparison finds those that are
  // subnormal.
  const std::uint16_t bits = Imath::half(value).bits();
  return bits < kSmallestNormal ? 0 : bits;
}

float half_value(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return h;
}

}  // namespace domefall
