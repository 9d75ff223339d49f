#include "pipeline/render/scene/seen_magnitude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

// A table that is linear in the logarithms of T and of the flux.
class FluxOfVZero {
 public:
  double operator()(double temperature) const {
    if (!(temperature > kCoolest && temperature < kHottest))
      return bolometric_flux_at_v_zero(temperature);
    const double at = std::log(temperature / kCoolest) / step();
    const auto k = std::min(static_cast<std::size_t>(at), kNodes - 2);
    const double w = at - static_cast<double>(k);
    return std::exp(logarithm_[k] + w * (logarithm_[k + 1] - logarithm_[k]));
  }

  FluxOfVZero() {
    for (std::size_t k = 0; k < kNodes; ++k)
      logarithm_[k] =
          std::log(bolometric_flux_at_v_zero(kCoolest * std::exp(step() * static_cast<double>(k))));
  }

 private:
  static constexpr double kCoolest = 500, kHottest = 1e6;
  static constexpr std::size_t kNodes = 4096;
  static double step() { return std::log(kHottest / kCoolest) / (kNodes - 1); }
  std::array<double, kNodes> logarithm_;
};

}  // namespace

double flux_of_v_zero(double temperature) {
  static const FluxOfVZero table;
  return table(temperature);
}

double seen_magnitude(const Effects& effects, double v, double temperature, double brightening,
                      double g) {
  const double seen = temperature * colour_ratio(effects, g);
  return v - 2.5 * std::log10(brightening * (flux_of_v_zero(temperature) / flux_of_v_zero(seen)));
}

}  // namespace domefall
