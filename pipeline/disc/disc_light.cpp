#include "pipeline/disc/disc_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/colour/blackbody.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/lanes.h"

namespace domefall {
namespace {

// The table has even steps in v = sqrt(6/r).  It has so many intervals from r = infinity, where v =
// 0, to the last stable orbit, which is the node v = 1, and goes on to the horizon.
constexpr int kPerUnit = 4096;
const double kInnermost = std::sqrt(kLastStableOrbit / kHorizonRadius);
constexpr double kMostRadiance = 1e36;
constexpr std::size_t kRadiiAtOnce = 128;

double log2_above_singular(const PageThorneProfile& profile, bool plunging, double v) {
  // At its ends the formula is infinite less infinite.  The difference is smooth there, so it is
  // taken a little inside them.
  constexpr double kOff = 1e-6;
  const double inside = plunging ? v : std::min(v, 1 - kOff), x = std::max(inside, kOff);
  const double t = std::log2(profile.temperature(kLastStableOrbit / (x * x))) - 1.5 * std::log2(x);
  return plunging ? t : t - 0.5 * std::log2(1 - x);
}

// An ObservedBlock holds what the places of a block have in common.
struct ObservedBlock {
  const float* table;
  float edge;  // the power of 1 - v in the temperature: 1/2, or 0 of gas that plunges
  float hottest, log2_scale, log2_t_max;
};

// Finds log2 of the observed temperature, at most that of kRayleighJeans, and the bolometric
// radiance that goes with it, times the scale.  The table is read by a loop of its own, since reads
// at computed places would keep the rest from becoming SIMD code.
[[gnu::always_inline]] inline void observe_loop(const ObservedBlock& block, const float* r,
                                                const float* g, int count, float* log2_t,
                                                float* radiance) {
  constexpr float kLog2Six = 2.5849625f, kLeast = 1e-30f;
  const ObservedBlock b = block;
  const auto end = static_cast<float>(kInnermost * kPerUnit);
  std::array<int, kRadiiAtOnce> nodes;
  std::array<float, kRadiiAtOnce> parts, sums;
  for (int k = 0; k < count; ++k) {
    const float v = __builtin_sqrtf(6.0f / r[k]), scaled = v * kPerUnit;
    const float at = scaled < end ? scaled : end;
    nodes[k] = static_cast<int>(at);
    parts[k] = at - static_cast<float>(nodes[k]);
    const float rest = (r[k] - 6.0f) / (r[k] * (1.0f + v));  // 1 - v
    const float edge = b.edge * binary_logarithm(rest > kLeast ? rest : kLeast);
    const float shift = binary_logarithm(g[k] > kLeast ? g[k] : kLeast);
    const float far = 0.75f * (kLog2Six - binary_logarithm(r[k]));
    sums[k] = b.log2_t_max + far + edge + shift;
  }
  for (int k = 0; k < count; ++k) {
    const float low = b.table[nodes[k]], high = b.table[nodes[k] + 1];
    sums[k] += low + parts[k] * (high - low);
  }
  for (int k = 0; k < count; ++k) {
    const float t = sums[k], seen = t < b.hottest ? t : b.hottest;
    const float power = b.log2_scale + 3.0f * seen + t;
    log2_t[k] = r[k] >= 2.0f ? seen : 0.0f;
    radiance[k] = power_of_two(power < 119.0f ? power : 119.0f);
  }
}
Dispatched<observe_loop> observe;

}  // namespace

DiscLight::DiscLight(const Disc& disc)
    : disc_(disc), profile_(disc.plunging), scale_(disc.luminance / blackbody_xyz(disc.t_max_k).y) {
  const int nodes = static_cast<int>(std::ceil(kInnermost * kPerUnit)) + 2;
  for (int k = 0; k < nodes; ++k) {
    const double v = std::min(static_cast<double>(k) / kPerUnit, kInnermost);
    table_.push_back(static_cast<float>(log2_above_singular(profile_, disc.plunging, v)));
  }
}

double DiscLight::temperature(double r) const { return disc_.t_max_k * profile_.temperature(r); }

WorkingRgb DiscLight::light(double r, double g) const {
  const double t = g * temperature(r), seen = std::min(t, kRayleighJeans);
  const WorkingRgb c = blackbody_colours().per_flux(seen);
  // Beyond kRayleighJeans the light grows with the first power of the temperature.
  const double beyond = t > seen ? t / seen : 1;
  const double radiance = std::min(blackbody_radiance(seen) * scale_ * beyond, kMostRadiance);
  const auto f = static_cast<float>(radiance);
  return {c.r * f, c.g * f, c.b * f};
}

void DiscLight::light(std::span<const float> r, std::span<const float> g,
                      std::span<WorkingRgb> out) const {
  const ObservedBlock block{table_.data(), disc_.plunging ? 0.0f : 0.5f,
                            static_cast<float>(std::log2(kRayleighJeans)),
                            static_cast<float>(std::log2(blackbody_radiance(1) * scale_)),
                            static_cast<float>(std::log2(disc_.t_max_k))};
  const BlackbodyColours& colours = blackbody_colours();
  std::array<float, kRadiiAtOnce> log2_t, radiance;
  for (std::size_t at = 0; at < r.size(); at += kRadiiAtOnce) {
    const std::size_t count = std::min(kRadiiAtOnce, r.size() - at);
    observe(block, r.data() + at, g.data() + at, static_cast<int>(count), log2_t.data(),
            radiance.data());
    for (std::size_t k = 0; k < count; ++k) {
      const WorkingRgb c = colours.per_flux_log2(log2_t[k]);
      out[at + k] = {c.r * radiance[k], c.g * radiance[k], c.b * radiance[k]};
    }
  }
}

}  // namespace domefall
