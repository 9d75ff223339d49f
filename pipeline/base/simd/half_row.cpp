#include "pipeline/base/simd/half_row.h"

#include <algorithm>
#include <array>
#include <bit>

#include "pipeline/base/simd/dispatch.h"

#if DOMEFALL_X86
#include <immintrin.h>
#endif

namespace domefall {

namespace {

constexpr std::int32_t kLargestHalf = 0x477fe000;  // 65504

// Converts the floats and returns the bits of the largest absolute value among them.
[[gnu::always_inline]] inline std::int32_t convert_loop(const float* values, int count,
                                                        std::uint16_t* out) {
  constexpr std::int32_t kExponent = 0x7f800000;
  constexpr std::int32_t kOctave = 1 << 23;                       // a step of the exponent by one
  constexpr std::int32_t kSmallestNormal = (127 - 14) * kOctave;  // 2^-14
  std::int32_t largest = 0;
  for (int k = 0; k < count; ++k) {
    const auto value = std::bit_cast<std::int32_t>(values[k]);
    const std::int32_t size = value & 0x7fffffff;
    largest = std::max(largest, size);
    // As integers, the bits of positive floats are ordered like their values, and those of negative
    // floats are below 0.  So the clamp can be done on integers.
    const std::int32_t bounded = std::min(std::max(value, 0), kLargestHalf);
    const auto x = std::bit_cast<float>(bounded);
    const std::int32_t exponent = bounded & kExponent;
    const std::int32_t octave = std::max(exponent, kSmallestNormal);
    // A float has 13 bits more in its mantissa than a half.  Once 2^13 times its octave is added,
    // those 13 bits no longer fit, so the addition itself rounds to the precision of a half.
    const std::int32_t large = octave + 13 * kOctave;
    const std::int32_t bits = std::bit_cast<std::int32_t>(x + std::bit_cast<float>(large)) - large;
    // The rest of the sum's bits count the steps of a half from 0, as if this octave were the
    // first.  Every octave further adds 2^10 to the bits of a half.
    out[k] = static_cast<std::uint16_t>(bits + ((octave - kSmallestNormal) >> 13));
  }
  return largest;
}

#if DOMEFALL_X86

// The processor's own conversion rounds in the same way.  Each step writes twice 16 bytes past the
// caches, because a frame is larger than the caches and is not read before it is complete.
constexpr int kAtOnce = 16;

// Returns the number of halves before the first address at which such a step may begin, a multiple
// of 32 bytes.
int until_aligned(const std::uint16_t* out, int count) {
  const auto beyond = static_cast<int>(reinterpret_cast<std::uintptr_t>(out) / 2 % kAtOnce);
  return std::min(count, (kAtOnce - beyond) % kAtOnce);
}

[[gnu::target("avx2,f16c")]] std::int32_t convert_by_f16c(const float* values, int count,
                                                          std::uint16_t* out) {
  // The bits are compared as integers, as in convert_loop().
  const __m256i none = _mm256_setzero_si256(), most = _mm256_set1_epi32(kLargestHalf);
  const __m256i size = _mm256_set1_epi32(0x7fffffff);
  int k = until_aligned(out, count);
  const std::int32_t before = convert_loop(values, k, out);
  __m256i largest = _mm256_setzero_si256();
  for (; k + kAtOnce <= count; k += kAtOnce)
    for (int half = 0; half < kAtOnce; half += kAtOnce / 2) {
      const __m256i x = _mm256_castps_si256(_mm256_loadu_ps(values + k + half));
      largest = _mm256_max_epi32(largest, _mm256_and_si256(x, size));
      const __m256i bounded = _mm256_min_epi32(_mm256_max_epi32(x, none), most);
      _mm_stream_si128(reinterpret_cast<__m128i*>(out + k + half),
                       _mm256_cvtps_ph(_mm256_castsi256_ps(bounded), _MM_FROUND_TO_NEAREST_INT));
    }
  _mm_sfence();  // orders the writes past the caches before all later ones
  alignas(32) std::array<std::int32_t, 8> lanes;
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes.data()), largest);
  return std::max({before, *std::max_element(lanes.begin(), lanes.end()),
                   convert_loop(values + k, count - k, out + k)});
}

#endif

std::int32_t convert(const float* values, int count, std::uint16_t* out) {
#if DOMEFALL_X86
  if (simd_in_use() != Simd::kPortable) return convert_by_f16c(values, count, out);
#endif
  return convert_loop(values, count, out);
}

}  // namespace

bool to_half(const float* values, int count, std::uint16_t* out) {
  constexpr std::int32_t kInfinity = 0x7f800000;
  return convert(values, count, out) < kInfinity;
}

}  // namespace domefall
