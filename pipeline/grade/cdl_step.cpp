#include "pipeline/grade/cdl_step.h"

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

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

void CdlStep::apply(PixelPlanes& planes, int count) const {
  FloatCdl cdl{};
  for (std::size_t c = 0; c < 3; ++c) {
    cdl.slope[c] = static_cast<float>(cdl_.slope[c]);
    cdl.offset[c] = static_cast<float>(cdl_.offset[c]);
    cdl.power[c] = static_cast<float>(cdl_.power[c]);
  }
  cdl.saturation = static_cast<float>(cdl_.saturation);
  float *red = planes.red.data(), *green = planes.green.data(), *blue = planes.blue.data();
  if (cdl_.power == Cdl{}.power)
    change(red, green, blue, count, cdl);
  else
    change_with_power(red, green, blue, count, cdl);
}

}  // namespace domefall
