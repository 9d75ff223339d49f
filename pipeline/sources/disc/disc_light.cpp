#include "pipeline/sources/disc/disc_light.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/lanes.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/sources/colour/blackbody.h"
#include "pipeline/sources/disc/disc.h"

namespace domefall {
namespace {

constexpr double kPullOnPlunge = 0.02, kStartOfPlunge = 0.01;

// Returns artanh t - t (sign 1) or t - atan t (sign -1) for 0 <= t < 0.71.  Where the two terms
// would cancel, it is the sum of a series, whose rest is below 2e-17 of it.
double beyond_linear(double t, double sign) {
  if (t > 0.1) return sign > 0 ? std::atanh(t) - t : t - std::atan(t);
  const double t2 = sign * t * t;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = sum * t2 + 1.0 / k;
  return t * t * t * sum;
}

// The table has even steps in v = sqrt(r_s/r).  It has so many intervals from r = infinity, where v
// = 0, to the last stable orbit, which is the node v = 1, and goes on to the horizon.
constexpr int kPerUnit = 4096;
double v_at_horizon(const GasOrbits& orbits) {
  return std::sqrt(orbits.last_stable() / orbits.horizon());
}
constexpr double kMostRadiance = 1e36;
constexpr std::size_t kRadiiAtOnce = 128;

double log2_above_singular(const PageThorneProfile& profile, const Disc& disc, double v) {
  // At its ends the formula is infinite less infinite.  The difference is smooth there, so it is
  // taken a little inside them.
  constexpr double kOff = 1e-6;
  const double inside = disc.plunging ? v : std::min(v, 1 - kOff), x = std::max(inside, kOff);
  const double r = disc.orbits.last_stable() / (x * x);
  const double t = std::log2(profile.temperature(r)) - 1.5 * std::log2(x);
  return disc.plunging ? t : t - 0.5 * std::log2(1 - x);
}

// An ObservedBlock holds what the places of a block have in common.
struct ObservedBlock {
  const float* table;
  float edge;  // the power of 1 - v in the temperature: 1/2, or 0 of gas that plunges
  float hottest, log2_scale, log2_t_max;
  float last_stable, log2_last_stable, horizon, end;  // the table ends at the node `end`
};

// Finds log2 of the observed temperature, at most that of kRayleighJeans, and the bolometric
// radiance that goes with it, times the scale.  The table is read by a loop of its own, since reads
// at computed places would keep the rest from becoming SIMD code.
[[gnu::always_inline]] inline void observe_loop(const ObservedBlock& block, const float* r,
                                                const float* g, int count, float* log2_t,
                                                float* radiance) {
  constexpr float kLeast = 1e-30f;
  const ObservedBlock b = block;
  std::array<int, kRadiiAtOnce> nodes;
  std::array<float, kRadiiAtOnce> parts, sums;
  for (int k = 0; k < count; ++k) {
    const float v = __builtin_sqrtf(b.last_stable / r[k]), scaled = v * kPerUnit;
    const float at = scaled < b.end ? scaled : b.end;
    nodes[k] = static_cast<int>(at);
    parts[k] = at - static_cast<float>(nodes[k]);
    const float rest = (r[k] - b.last_stable) / (r[k] * (1.0f + v));  // 1 - v
    const float edge = b.edge * binary_logarithm(rest > kLeast ? rest : kLeast);
    const float shift = binary_logarithm(g[k] > kLeast ? g[k] : kLeast);
    const float far = 0.75f * (b.log2_last_stable - binary_logarithm(r[k]));
    sums[k] = b.log2_t_max + far + edge + shift;
  }
  for (int k = 0; k < count; ++k) {
    const float low = b.table[nodes[k]], high = b.table[nodes[k] + 1];
    sums[k] += low + parts[k] * (high - low);
  }
  for (int k = 0; k < count; ++k) {
    const float t = sums[k], seen = t < b.hottest ? t : b.hottest;
    const float power = b.log2_scale + 3.0f * seen + t;
    log2_t[k] = r[k] >= b.horizon ? seen : 0.0f;
    radiance[k] = power_of_two(power < 119.0f ? power : 119.0f);
  }
}
Dispatched<observe_loop> observe;

double circular_shift(const GasOrbits& orbits, const GasRay& ray, double r) {
  const double omega = orbits.circling(r);
  return (ray.energy - omega * ray.about_axis) / std::sqrt(orbits.slowing_squared(r));
}

// Where light and gas both move inwards, the two terms of the numerator cancel next to the horizon, and
// the difference of their squares is divided by their sum instead.
double plunging_shift(const GasOrbits& orbits, const GasRay& ray, double r, bool outward) {
  const double a = orbits.spin(), square = r * r + a * a, above = orbits.delta(r);
  const double own_energy = orbits.plunge_energy(), own_momentum = orbits.plunge_momentum();
  const double p = square * ray.energy - a * ray.about_axis,
               own_p = square * own_energy - a * own_momentum;
  const double y = ray.about_axis - a * ray.energy, own_y = own_momentum - a * own_energy;
  const double k = ray.momentum * ray.momentum, own_k = r * r + own_y * own_y;
  const double speed = std::sqrt(std::max(0.0, p * p - above * k)),
               own_speed = r * r * orbits.plunge_speed(r);
  const double sum = p * own_p + speed * own_speed;
  const double radial =
      outward ? sum / above : (p * p * own_k + own_p * own_p * k - above * k * own_k) / sum;
  return (radial - y * own_y) / (r * r);
}

}  // namespace

PageThorneProfile::PageThorneProfile(bool plunging, const GasOrbits& orbits)
    : orbits_(orbits), plunging_(plunging) {
  const double q2 = orbits.charge_squared(), light_circle = (3 + std::sqrt(9 - 8 * q2)) / 2;
  a_ = light_circle - q2;
  d_ = q2 * (1 - 2 / light_circle);
  // A function is flat next to its maximum, so its values tell the place to half of a double's bits
  // only.
  constexpr double kBeyond = 30;
  constexpr int kBits = 26;
  const double edge = orbits.last_stable();
  const double slowing = std::sqrt(orbits.slowing_squared(edge));
  pull_ = plunging ? orbits.plunge_momentum() * slowing * kPullOnPlunge : 0;
  const auto found = boost::math::tools::brent_find_minima(
      [this](double r) { return -stable_flux(r); }, edge, kBeyond, kBits);
  hottest_ = stable_flux(edge) > -found.second ? edge : found.first;
  greatest_ = stable_flux(hottest_);
}

// From the edge, y = y_s, on B is the difference of y and of three inverse functions.  Of first
// order in d = y - y_s all terms together cancel, so they are combined by hand.
double PageThorneProfile::brought(double r) const {
  if (orbits_.spin() != 0) return brought_by_quadrature(r);
  const double q2 = orbits_.charge_squared(), q = std::sqrt(q2);
  const double start = orbits_.last_stable() - q2, first = std::sqrt(start);  // y_s^2, y_s
  const double y = std::sqrt(r - q2), d = (r - orbits_.last_stable()) / (y + first);
  const double product = y * first, below = product - a_;
  const double second =
      first * d * d / below * (a_ / (start - a_)) +
      first * d * d *
          (2 * q2 / ((q2 + product) * (q2 + start)) - d_ / ((d_ + product) * (d_ + start)));
  const double root_a = std::sqrt(a_), root_d = std::sqrt(d_);
  return second + 2 * q * beyond_linear(q * d / (q2 + product), -1) -
         root_d * beyond_linear(root_d * d / (d_ + product), -1) -
         root_a * beyond_linear(root_a * d / below, 1);
}

double PageThorneProfile::brought_by_quadrature(double r) const {
  const double a = orbits_.spin(), q2 = orbits_.charge_squared(), edge = orbits_.last_stable();
  const auto rate = [&](double at) {  // by y
    const double w2 = at - q2, w = std::sqrt(w2);
    const double under = at * (at - 3) + 2 * q2 + 2 * a * w, n = at * std::sqrt(under);
    const double energy = (at * (at - 2) + q2 + a * w) / n,
                 momentum = (w * (at * at + a * a) - a * (2 * at - q2)) / n;
    const double stable =
        at * ((6 - at) * at - 9 * q2 + 3 * a * a) + 4 * q2 * (q2 - a * a) - 8 * a * w2 * w;
    const double y = momentum - a * energy, p = at * at * energy - a * y;
    const double by_energy = 4 * at * (energy * (at * at + a * a) + p) + 4 * a * (at - 1) * y,
                 by_momentum = -4 * (a * at * energy + (at - 1) * y);
    const double omega = orbits_.circling(at);
    const double by_r = -2 * stable / under / (omega * by_energy + by_momentum);
    return (energy - omega * momentum) * by_r * 2 * w;
  };
  const double first = std::sqrt(edge - q2), last = std::sqrt(r - q2);
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
      [&](double y) { return rate(y * y + q2); }, first, last, 8, 1e-13);
}

// Up to a constant.
double PageThorneProfile::stable_flux(double r) const {
  const double q2 = orbits_.charge_squared();
  // Without the 1.5 its unit would not be that of the formula below.
  if (orbits_.spin() != 0)
    return (brought(r) + pull_) * orbits_.shear(r) * orbits_.circling(r) /
           (1.5 * r * r * orbits_.slowing_squared(r));
  const double over = (r - 3 + 2 * q2 / r) * r * r * std::sqrt(r - q2);
  return (brought(r) + pull_) / over * (1 - 4 * q2 / (3 * r));
}

double PageThorneProfile::flux(double r) const {
  const double edge = orbits_.last_stable();
  if (r >= edge) return stable_flux(r) / greatest_;
  if (!plunging_ || r < orbits_.horizon()) return 0;
  return stable_flux(edge) / greatest_ * std::pow(edge / r, 17.0 / 7) *
         std::pow(1 + orbits_.fall(r) / kStartOfPlunge, -1.0 / 7);
}

double PageThorneProfile::temperature(double r) const { return std::sqrt(std::sqrt(flux(r))); }

DiscLight::DiscLight(const Disc& disc)
    : disc_(disc),
      profile_(disc.plunging, disc.orbits),
      scale_(disc.luminance / blackbody_xyz(disc.t_max_k).y) {
  if (!disc.patterns.empty()) pattern_.emplace(disc.patterns, disc.orbits);
  const double innermost = v_at_horizon(disc.orbits);
  const int nodes = static_cast<int>(std::ceil(innermost * kPerUnit)) + 2;
  for (int k = 0; k < nodes; ++k) {
    const double v = std::min(static_cast<double>(k) / kPerUnit, innermost);
    table_.push_back(static_cast<float>(log2_above_singular(profile_, disc, v)));
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
  const GasOrbits& orbits = disc_.orbits;
  const ObservedBlock block{table_.data(),
                            disc_.plunging ? 0.0f : 0.5f,
                            static_cast<float>(std::log2(kRayleighJeans)),
                            static_cast<float>(std::log2(blackbody_radiance(1) * scale_)),
                            static_cast<float>(std::log2(disc_.t_max_k)),
                            static_cast<float>(orbits.last_stable()),
                            static_cast<float>(std::log2(orbits.last_stable())),
                            static_cast<float>(orbits.horizon()),
                            static_cast<float>(v_at_horizon(orbits) * kPerUnit)};
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

double depth_across(const Disc& disc, double r, double seen_from) {
  double depth = disc.optical_depth;
  const auto thin_out = [&depth](double way, double rim) {
    const double t = way / rim;
    if (rim > 0 && t < 1) depth *= t > 0 ? t * t * t * (t * (6 * t - 15) + 10) : 0;
  };
  // No rim takes more than its half of the disc, so that gas is as thick as it can be in the middle.
  const double half = (disc.outer - disc.inner) / 2;
  thin_out(1 - r / disc.outer, std::min(disc.rim, half / disc.outer));
  const double horizon = disc.orbits.horizon(), rim = std::min(disc.rim, half / disc.inner);
  thin_out(r / disc.inner - 1, disc.inner > horizon ? rim : std::min(rim, 1 - seen_from / horizon));
  return depth;
}

double absorbed_part(const Disc& disc, double r, double seen_from, double steepness) {
  if (disc.is_opaque()) return 1;
  const double depth = depth_across(disc, r, seen_from);
  constexpr double kOpaque = 40, kGrazing = 1e-9;
  if (depth > kOpaque * steepness) return 1;
  return 1 - exponential(-depth / std::max(steepness, kGrazing));
}

GasRay disc_ray(const RayInvariants& ray, const V3d& place, const V3d& tangent, const V3d& normal) {
  return {ray.energy, ray.angular_momentum,
          -ray.angular_momentum * place.cross(tangent).dot(normal)};
}

double disc_shift(const GasOrbits& orbits, const GasRay& ray, double r, bool outward) {
  return r < orbits.last_stable() ? plunging_shift(orbits, ray, r, outward)
                                  : circular_shift(orbits, ray, r);
}

}  // namespace domefall
