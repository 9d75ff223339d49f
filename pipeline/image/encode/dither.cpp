#include "pipeline/image/encode/dither.h"

#include <cstddef>

namespace domefall {
namespace {

constexpr std::uint32_t kStep = 257;  // 16-bit codes in a step of 8 bits

// A number without visible order.  [Wellons] "Prospecting for hash functions", lowbias32.
constexpr std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352dU;
  x = (x ^ x >> 15) * 0x846ca68bU;
  return x ^ x >> 16;
}

// A 16-bit number as one below kStep.
constexpr std::uint32_t even(std::uint32_t bits) { return bits * kStep >> 16; }

// floor((value + n)/kStep), where n has each whole number below kStep as often, has the mean
// value/kStep exactly (Hermite's identity).
constexpr std::uint8_t rounded(std::uint32_t value, std::uint32_t noise) {
  constexpr std::uint32_t kHalf = kStep / 2, kWhite = 65535;
  const std::uint32_t first = even(noise & 0xffff), second = even(noise >> 16);
  const bool inside = value >= kHalf && value <= kWhite - kHalf;
  return static_cast<std::uint8_t>((value + first + (inside ? second - kHalf : 0)) / kStep);
}

}  // namespace

void dither_rows(const unsigned short* rgb, int width, int rows, int y, int frame,
                 std::uint8_t* out) {
  const std::size_t count = 3 * static_cast<std::size_t>(width);
  for (int row = 0; row < rows; ++row, rgb += count, out += count) {
    const std::uint32_t seed = scrambled(scrambled(static_cast<std::uint32_t>(frame)) +
                                         static_cast<std::uint32_t>(y + row));
    for (std::size_t k = 0; k < count; ++k)
      out[k] = rounded(rgb[k], scrambled(seed + static_cast<std::uint32_t>(k)));
  }
}

}  // namespace domefall
