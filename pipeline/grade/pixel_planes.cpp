#include "pipeline/grade/pixel_planes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"

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

// ACEScct is linear up to this light, and logarithmic above.
constexpr float kStraight = 0.0078125f, kStraightCode = 0.155251141552511f;
constexpr float kCodeSlope = 10.5402377416545f, kCodeOffset = 0.0729055341958355f;
constexpr float kStops = 17.52f, kStopOffset = 9.72f;
// Powers of two are cut here to stay within floats.  The light of half floats stays far below.
constexpr float kMostStops = 100;

[[gnu::always_inline]] inline float code_of_light(float light) {
  const float bright = light > kStraight ? light : kStraight;
  const float logarithm = (binary_logarithm(bright) + kStopOffset) * (1 / kStops);
  return light > kStraight ? logarithm : kCodeSlope * light + kCodeOffset;
}

[[gnu::always_inline]] inline float light_of_code(float code) {
  const float stops = code * kStops - kStopOffset;
  const float light = power_of_two(stops < kMostStops ? stops : kMostStops);
  return code > kStraightCode ? light : (code - kCodeOffset) * (1 / kCodeSlope);
}

struct FloatCdl {
  float slope[3], offset[3], power[3], saturation;
};

template <bool kPower>
[[gnu::always_inline]] inline float changed_code(const FloatCdl& cdl, int channel, float light) {
  const float code = code_of_light(light) * cdl.slope[channel] + cdl.offset[channel];
  if constexpr (!kPower) return code;
  const float stops = binary_logarithm(code > 1e-30f ? code : 1e-30f) * cdl.power[channel];
  const float raised = power_of_two(stops < kMostStops ? stops : kMostStops);
  return code > 0 ? raised : code;
}

template <bool kPower>
[[gnu::always_inline]] inline void change_loop(float* __restrict red, float* __restrict green,
                                               float* __restrict blue, int count,
                                               const FloatCdl& cdl) {
  // These are the CDL's own weights, those of Rec.709.
  constexpr float kRed = 0.2126f, kGreen = 0.7152f, kBlue = 0.0722f, kFinite = 1e30f;
  const float saturation = cdl.saturation;
  for (int k = 0; k < count; ++k) {
    const float in = red[k];
    const bool black = (in == 0) & (green[k] == 0) & (blue[k] == 0);
    const float r = changed_code<kPower>(cdl, 0, in), g = changed_code<kPower>(cdl, 1, green[k]),
                b = changed_code<kPower>(cdl, 2, blue[k]);
    const float luma = kRed * r + kGreen * g + kBlue * b;
    const float x = light_of_code(luma + saturation * (r - luma)),
                y = light_of_code(luma + saturation * (g - luma)),
                z = light_of_code(luma + saturation * (b - luma));
    const bool good = (in >= 0) & (x > -kFinite) & (y > -kFinite) & (z > -kFinite);
    red[k] = black ? 0.0f : good ? x : -1.0f;
    green[k] = black ? 0.0f : good ? y : -1.0f;
    blue[k] = black ? 0.0f : good ? z : -1.0f;
  }
}
Dispatched<change_loop<false>> change;
Dispatched<change_loop<true>> change_with_power;

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

void apply_cdl(const Cdl& given, PixelPlanes& planes, int count) {
  FloatCdl cdl{};
  for (std::size_t c = 0; c < 3; ++c) {
    cdl.slope[c] = static_cast<float>(given.slope[c]);
    cdl.offset[c] = static_cast<float>(given.offset[c]);
    cdl.power[c] = static_cast<float>(given.power[c]);
  }
  cdl.saturation = static_cast<float>(given.saturation);
  float *red = planes.red.data(), *green = planes.green.data(), *blue = planes.blue.data();
  if (given.power == Cdl{}.power)
    change(red, green, blue, count, cdl);
  else
    change_with_power(red, green, blue, count, cdl);
}

}  // namespace domefall
