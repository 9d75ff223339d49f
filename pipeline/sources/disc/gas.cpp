#include "pipeline/sources/disc/gas.h"

#include <algorithm>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

// Returns the product of two Gaussians.
double gaussians(double x, double y) { return exponential(-(x * x + y * y) / 2); }

// Gas is left out where its Gaussians are below 1e-5.
constexpr double kSigmas = 4.8;

// Returns the angle from the nearer end of the axis.
double from_axis(double latitude_sine) {
  const double s = std::min(1.0, std::abs(latitude_sine));
  return arc_tangent2(std::sqrt((1 - s) * (1 + s)), s);
}

}  // namespace

double density(const Halo& halo, const GasOrbits& hole, const GasPlace& at) {
  if (at.r <= hole.horizon()) return 0;
  return hole.delta(at.r) / (at.r * at.r + hole.spin() * hole.spin()) *
         gaussians(at.r / halo.r, at.latitude_sine / halo.height);
}

double density(const Jet& jet, const GasOrbits& hole, const GasPlace& at) {
  if (longest_step(jet, std::abs(at.latitude_sine), 0) == HUGE_VAL) return 0;
  const double x = std::min(1.0, (at.r - hole.horizon()) / jet.r), over = jet.r / at.r;
  if (x <= 0) return 0;
  return over * over * x * x * (3 - 2 * x) *
         gaussians(from_axis(at.latitude_sine) / jet.opening, at.r / jet.length);
}

namespace {

// The metric at a place, in the coordinates of Boyer and Lindquist: g^tt = A/(Delta Sigma) and
// g^tphi = D/(Delta Sigma).
struct HolePlace {
  double spin, square, sigma, delta, sine2, a, d;

  HolePlace(const GasOrbits& hole, const GasPlace& at)
      : spin(hole.spin()), square(at.r * at.r + spin * spin), delta(hole.delta(at.r)) {
    const double s = at.latitude_sine;
    sine2 = std::max(1e-12, (1 - s) * (1 + s));
    sigma = at.r * at.r + spin * spin * s * s;
    a = square * square - delta * spin * spin * sine2;
    d = spin * (2 * at.r - hole.charge_squared());
  }
};

}  // namespace

// With u_t = [g^tt - 2 l g^tphi + l^2 g^phiphi]^(-1/2) its four-velocity has the parts u_t (1, -l), so
// that k.u = u_t [g^tt E - g^tphi (l E + L_n) + g^phiphi l L_n].
double sent_frequency(const Halo&, const GasOrbits& hole, const GasRay& ray, const GasPlace& at) {
  const HolePlace p(hole, at);
  const double rho = at.r * std::sqrt(p.sine2), l = rho * std::sqrt(rho) / (1 + rho);
  const double round = (p.delta - p.spin * p.spin * p.sine2) / p.sine2;  // of -g^phiphi
  const double over = p.delta * p.sigma;
  return (p.a * ray.energy - p.d * (l * ray.energy + ray.about_axis) - round * l * ray.about_axis) /
         std::sqrt(over * (p.a - 2 * p.d * l - round * l * l));
}

// Against whoever has no angular momentum, light has the energy (E - omega L)/alpha, and a part of it
// goes outwards.
double sent_frequency(const Jet& jet, const GasOrbits& hole, const GasRay& ray,
                      const GasPlace& at) {
  const HolePlace p(hole, at);
  const double l = ray.about_axis, y = l - p.spin * ray.energy * p.sine2;
  const double energy = (ray.energy - p.d / p.a * l) * std::sqrt(p.a / (p.delta * p.sigma));
  const double around = std::max(0.0, (ray.momentum * ray.momentum - y * y / p.sine2) / p.sigma +
                                          l * l * p.sigma / (p.a * p.sine2)) /
                        (energy * energy);
  const double radial =
      std::min(1.0, std::abs(at.rising) / (energy * std::sqrt(p.delta * p.sigma)));
  // gamma - sqrt(gamma^2 - 1) x is 1/(gamma + ...) for x = 1, without a difference of like numbers.
  const double g = jet.lorentz, own = std::sqrt((g - 1) * (g + 1));
  const double against =
      at.rising > 0 ? 1 / (g + own) + own * (around / (1 + radial)) : g + own * radial;
  return energy * against;
}

double reach(const Halo& halo) { return kSigmas * halo.r; }
double reach(const Jet& jet) { return kSigmas * jet.length; }

double longest_step(const Halo& halo, double latitude_sine, double length) {
  return latitude_sine > kSigmas * halo.height + length ? HUGE_VAL : halo.height / 2;
}

double longest_step(const Jet& jet, double latitude_sine, double length) {
  // Most places are far from the axis, which the cosine tells by itself: 1 - a^2/2 <= cos a.
  const double wide = kSigmas * jet.opening + length;
  if (latitude_sine < 1 - wide * wide / 2 - 1e-9) return HUGE_VAL;
  return jet.opening / 2;
}

namespace {

constexpr double kLogRange = 14;  // g from e^-14 to e^14
constexpr int kPerLog = 512;

}  // namespace

GasColour::GasColour(const GasTemperature& temperature, double luminance, double across,
                     bool coloured, bool dimmed) {
  const double scale = luminance / across;
  const double own = temperature ? blackbody_xyz(*temperature).y : 1;
  for (int k = 0; k <= 2 * kLogRange * kPerLog; ++k) {
    const double g = exponential(k / static_cast<double>(kPerLog) - kLogRange);
    WorkingRgb light{1, 1, 1};
    double factor = scale;
    if (temperature) {
      const double t = *temperature * (coloured ? g : 1);
      light = blackbody_colours().surface(t);
      // A surface's light has g^4 in its colour.
      const double g4 = g * g * g * g;
      factor *= (coloured == dimmed ? 1 : dimmed ? g4 : 1 / g4) / own;
    } else if (dimmed) {
      factor *= g * g * g;
    }
    const auto value = [factor](float part) {
      return static_cast<float>(std::min(factor * static_cast<double>(part), 1e30));
    };
    table_.push_back({value(light.r), value(light.g), value(light.b)});
  }
}

WorkingRgb GasColour::light(double g) const {
  const double last = static_cast<double>(table_.size()) - 1.001;
  const double at = std::clamp((logarithm(std::max(g, 1e-300)) + kLogRange) * kPerLog, 0.0, last);
  const auto node = static_cast<std::size_t>(at);
  const auto part = static_cast<float>(at - static_cast<double>(node));
  const auto value = [&](std::size_t c) {
    const float low = table_[node][c];
    return low + part * (table_[node + 1][c] - low);
  };
  return {value(0), value(1), value(2)};
}

}  // namespace domefall
