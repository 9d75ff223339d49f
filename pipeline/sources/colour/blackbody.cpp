#include "pipeline/sources/colour/blackbody.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/sources/colour/cie1931.h"

namespace domefall {
namespace {

// h, c and k are exact in the SI of 2019, and sigma follows.
constexpr double kPlanck = 6.62607015e-34, kLight = 299792458.0, kBoltzmann = 1.380649e-23;
constexpr double kStefanBoltzmann = 5.670374419e-8;

constexpr double kCoolest = 500;
constexpr int kNodes = 4096;

// This is the V response of Bessell (1990) at 470, 480, ... 700 nm.
constexpr std::array<double, 24> kBessellV{0,     0.03,  0.163, 0.458, 0.78,  0.967, 1,     0.973,
                                           0.898, 0.792, 0.684, 0.574, 0.461, 0.359, 0.27,  0.197,
                                           0.135, 0.081, 0.045, 0.025, 0.017, 0.013, 0.009, 0};
constexpr double kVZeroPoint = 3.631e-11;  // W/m^2/nm at V = 0

double node_log() { return std::log(kRayleighJeans / kCoolest) / (kNodes - 1); }

}  // namespace

double planck(double wavelength_nm, double temperature) {
  const double m = wavelength_nm * 1e-9;
  const double x = kPlanck * kLight / (m * kBoltzmann * temperature);
  return 2 * kPlanck * kLight * kLight / (m * m * m * m * m) / std::expm1(x) * 1e-9;
}

Xyz blackbody_xyz(double temperature) {
  Xyz sum{0, 0, 0};
  for (std::size_t k = 0; k < kCie1931.size(); ++k) {
    const double light = planck(kCieFirstNm + kCieStepNm * static_cast<double>(k), temperature);
    sum.x += light * kCie1931[k][0];
    sum.y += light * kCie1931[k][1];
    sum.z += light * kCie1931[k][2];
  }
  const double scale = kLuminousEfficacy * kCieStepNm;
  return {sum.x * scale, sum.y * scale, sum.z * scale};
}

double blackbody_radiance(double temperature) {
  const double t2 = temperature * temperature;
  return kStefanBoltzmann * t2 * t2 / std::numbers::pi;
}

double bolometric_flux_at_v_zero(double temperature) {
  double weighted = 0, weight = 0;
  for (std::size_t k = 0; k < kBessellV.size(); ++k) {
    weighted += kBessellV[k] * planck(470 + 10 * static_cast<double>(k), temperature);
    weight += kBessellV[k];
  }
  if (!(weighted > 0)) return HUGE_VAL;  // below some 30 K no double holds the light in V
  return kVZeroPoint * weight / weighted * blackbody_radiance(temperature);
}

BlackbodyColours::BlackbodyColours() : table_(kNodes) {
  for (int k = 0; k < kNodes; ++k) {
    const double t = kCoolest * std::exp(node_log() * k);
    const Xyz xyz = blackbody_xyz(t);
    const double inverse = 1 / blackbody_radiance(t);
    const WorkingRgb c = to_working({xyz.x * inverse, xyz.y * inverse, xyz.z * inverse});
    // The coolest glows lie a little outside the AP1 triangle.
    table_[static_cast<std::size_t>(k)] = {std::max(c.r, 0.0f), std::max(c.g, 0.0f),
                                           std::max(c.b, 0.0f)};
  }
}

WorkingRgb BlackbodyColours::per_flux(double temperature) const {
  if (temperature < kCoolest) return {0, 0, 0};
  if (temperature >= kRayleighJeans) {
    // Visible light grows as T, and the total as T^4.
    const double fall = std::pow(kRayleighJeans / temperature, 3);
    const auto& last = table_.back();
    const auto f = static_cast<float>(fall);
    return {last[0] * f, last[1] * f, last[2] * f};
  }
  static const double inverse_step = 1 / node_log();
  const double at = std::log(temperature / kCoolest) * inverse_step;
  const auto k = std::min(static_cast<std::size_t>(at), table_.size() - 2);
  const auto w = static_cast<float>(at - static_cast<double>(k));
  const auto &a = table_[k], &b = table_[k + 1];
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2])};
}

WorkingRgb BlackbodyColours::per_flux_log2(float log2_temperature) const {
  static const auto coolest = static_cast<float>(std::log2(kCoolest));
  static const auto per_octave = static_cast<float>(std::numbers::ln2 / node_log());
  const float at = (log2_temperature - coolest) * per_octave;
  if (!(at >= 0)) return {0, 0, 0};
  const auto last = static_cast<float>(table_.size() - 1);
  if (at >= last) return per_flux(std::exp2(static_cast<double>(log2_temperature)));
  const auto k = static_cast<std::size_t>(at);
  const float w = at - static_cast<float>(k);
  const auto &a = table_[k], &b = table_[k + 1];
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2])};
}

WorkingRgb BlackbodyColours::surface(double temperature) const {
  const WorkingRgb c = per_flux(temperature);
  const double radiance = blackbody_radiance(temperature);
  return {static_cast<float>(c.r * radiance), static_cast<float>(c.g * radiance),
          static_cast<float>(c.b * radiance)};
}

const BlackbodyColours& blackbody_colours() {
  static const BlackbodyColours colours;
  return colours;
}

}  // namespace domefall
