#include "pipeline/sky/maps/sky_texel.h"

#include <Imath/half.h>

namespace domefall {

std::uint16_t half_bits(float value) {
  constexpr std::uint16_t kSmallestNormal = 0x0400;  // 2^-14
  const std::uint16_t bits = Imath::half(value).bits();
  return bits < kSmallestNormal ? 0 : bits;
}

float half_value(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return h;
}

}  // namespace domefall
