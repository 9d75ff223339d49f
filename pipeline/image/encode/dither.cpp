#include "pipeline/image/encode/dither.h"

namespace domefall {
namespace {

constexpr std::uint32_t kCodeStep = 257;  // 16-bit codes in a step of 8 bits

// Returns a hash of x, in which no order is visible.  It is lowbias32 of [Wellons] "Prospecting for
// hash functions".
constexpr std::uint32_t scrambled(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352dU;
  x = (x ^ x >> 15) * 0x846ca68bU;
  return x ^ x >> 16;
}

// Returns a 16-bit number as one below kCodeStep.
constexpr std::uint32_t even(std::uint32_t bits) { return bits * kCodeStep >> 16; }

// Returns x/kCodeStep rounded down, for x < 2^16 + kCodeStep.  It does so because 65281 kCodeStep =
// 2^24 + 1.
constexpr std::uint32_t steps_in(std::uint32_t x) { return x * 65281U >> 24; }
static_assert(steps_in(257) == 1 && steps_in(256) == 0 && steps_in(65791) == 255);

// floor((value + n)/kCodeStep), where n is each whole number below kCodeStep equally often, has the
// mean value/kCodeStep exactly (Hermite's identity).
constexpr std::uint8_t rounded(std::uint32_t value, std::uint32_t noise) {
  constexpr std::uint32_t kHalf = kCodeStep / 2, kWhite = 65535;
  const std::uint32_t first = even(noise & 0xffff), second = even(noise >> 16);
  const bool inside = value >= kHalf && value <= kWhite - kHalf;
  return static_cast<std::uint8_t>(steps_in(value + first + (inside ? second - kHalf : 0)));
}

// Dithers one row.  The loop is compiled for two instruction sets, because the products of the
// noise are slow without AVX2.
[[gnu::always_inline]] inline void dither_loop(const unsigned short* rgb, std::uint32_t count,
                                               std::uint32_t seed, std::uint8_t* out) {
  for (std::uint32_t k = 0; k < count; ++k) out[k] = rounded(rgb[k], scrambled(seed + k));
}

void dither_portably(const unsigned short* rgb, std::uint32_t count, std::uint32_t seed,
                     std::uint8_t* out) {
  dither_loop(rgb, count, seed, out);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void dither_by_avx2(const unsigned short* rgb, std::uint32_t count,
                                            std::uint32_t seed, std::uint8_t* out) {
  dither_loop(rgb, count, seed, out);
}
const auto kDitherRow = __builtin_cpu_supports("avx2") ? dither_by_avx2 : dither_portably;
#else
const auto kDitherRow = dither_portably;
#endif

}  // namespace

void dither_rows(const unsigned short* rgb, int width, int rows, int y, int frame,
                 std::uint8_t* out) {
  const auto count = 3 * static_cast<std::uint32_t>(width);
  for (int row = 0; row < rows; ++row, rgb += count, out += count)
    kDitherRow(rgb, count,
               scrambled(scrambled(static_cast<std::uint32_t>(frame)) +
                         static_cast<std::uint32_t>(y + row)),
               out);
}

}  // namespace domefall
