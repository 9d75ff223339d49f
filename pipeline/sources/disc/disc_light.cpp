#include "pipeline/sources/disc/disc_light.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/disc/disc.h"
#include "pipeline/spacetime/schwarzschild.h"

namespace domefall {
namespace {

constexpr double kPullOnPlunge = 0.02, kStartOfPlunge = 0.01;
const double kRoot3 = std::sqrt(3.0), kRoot6 = std::sqrt(6.0);

// Returns artanh t - t for 0 <= t < 0.71.  Where the two terms would cancel, it is the sum of a
// series, whose rest is below 2e-17 of it.
double beyond_linear_artanh(double t) {
  if (t > 0.1) return std::atanh(t) - t;
  const double t2 = t * t;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = sum * t2 + 1.0 / k;
  return t * t2 * sum;
}

// With d = sqrt r - sqrt 6 and t = sqrt 3 d/(sqrt(6 r) - 3), B = d - sqrt 3 artanh t.  Its terms of
// first order in d cancel, so they are combined by hand.
double page_thorne_b(double r) {
  const double root = std::sqrt(r), d = (r - kPlungesBelow) / (root + kRoot6);
  const double below = root * kRoot6 - 3;
  return kRoot6 * d * d / below - kRoot3 * beyond_linear_artanh(kRoot3 * d / below);
}

// The table has even steps in v = sqrt(6/r).  It has so many intervals from r = infinity, where v =
// 0, to the last stable orbit, which is the node v = 1, and goes on to the horizon.
constexpr int kPerUnit = 4096;
const double kInnermost = std::sqrt(kPlungesBelow / Schwarzschild::horizon());
constexpr double kMostRadiance = 1e36;
constexpr std::size_t kRadiiAtOnce = 128;

double log2_above_singular(const PageThorneProfile& profile, bool plunging, double v) {
  // At its ends the formula is infinite less infinite.  The difference is smooth there, so it is
  // taken a little inside them.
  constexpr double kOff = 1e-6;
  const double inside = plunging ? v : std::min(v, 1 - kOff), x = std::max(inside, kOff);
  const double t = std::log2(profile.temperature(kPlungesBelow / (x * x))) - 1.5 * std::log2(x);
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

double circular_shift(const DiscRay& ray, double r) {
  const double omega = 1 / (r * std::sqrt(r));
  return (ray.energy - omega * ray.about_axis) / std::sqrt(1 - 3 / r);
}

// Returns (E' E - u^r k^r)/(1 - 2/r) - L' L_n/r^2.  Where light and gas both move inwards, the two
// terms of the first numerator cancel next to the horizon, and the difference of their squares is
// divided by their sum instead.
double plunging_shift(const DiscRay& ray, double r, bool outward) {
  const double fall = kPlungesBelow / r - 1, above = 1 - Schwarzschild::horizon() / r;
  const double energy = std::sqrt(8.0 / 9), momentum = 2 * std::sqrt(3.0);
  const double speed = fall * std::sqrt(fall) / 3;  // -u^r
  const double l = ray.angular_momentum / r, own = momentum / r;
  const double radial = std::sqrt(std::max(0.0, ray.energy * ray.energy - above * l * l));
  const double turned = own * ray.about_axis / r;
  if (outward) return (energy * ray.energy + speed * radial) / above - turned;
  const double squares = ray.energy * ray.energy * (1 + own * own) + energy * energy * l * l -
                         above * (1 + own * own) * l * l;
  return squares / (energy * ray.energy + speed * radial) - turned;
}

}  // namespace

PageThorneProfile::PageThorneProfile(bool plunging)
    : plunging_(plunging), pull_(plunging ? kRoot6 * kPullOnPlunge : 0) {
  // A function is flat next to its maximum, so its values tell the place to half of a double's bits
  // only.
  constexpr double kBeyond = 30;
  constexpr int kBits = 26;
  const auto found = boost::math::tools::brent_find_minima(
      [this](double r) { return -stable_flux(r); }, kPlungesBelow, kBeyond, kBits);
  hottest_ = stable_flux(kPlungesBelow) > -found.second ? kPlungesBelow : found.first;
  greatest_ = stable_flux(hottest_);
}

double PageThorneProfile::stable_flux(double r) const {
  return (page_thorne_b(r) + pull_) / ((r - 3) * r * r * std::sqrt(r));
}

double PageThorneProfile::flux(double r) const {
  if (r >= kPlungesBelow) return stable_flux(r) / greatest_;
  if (!plunging_ || r < Schwarzschild::horizon()) return 0;
  const double x = kPlungesBelow / r, fall = (x - 1) * std::sqrt(x - 1);
  return stable_flux(kPlungesBelow) / greatest_ * std::pow(x, 17.0 / 7) *
         std::pow(1 + fall / kStartOfPlunge, -1.0 / 7);
}

double PageThorneProfile::temperature(double r) const { return std::sqrt(std::sqrt(flux(r))); }

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

DiscRay disc_ray(const RayInvariants& ray, const V3d& place, const V3d& tangent,
                 const V3d& normal) {
  return {ray.energy, ray.angular_momentum,
          -ray.angular_momentum * place.cross(tangent).dot(normal)};
}

double disc_shift(const DiscRay& ray, double r, bool outward) {
  return r < kPlungesBelow ? plunging_shift(ray, r, outward) : circular_shift(ray, r);
}

}  // namespace domefall
