#include "pipeline/sky/ring_sky.h"

#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"

namespace domefall {
namespace {

using std::numbers::pi;

constexpr double kTemperature = 3000;
constexpr double kLight = 4e-4, kDark = kLight / 4;  // cd/m^2

}  // namespace

WorkingRgb ring_glow(double phase, double width) {
  static const WorkingRgb colour = [] {
    const WorkingRgb c = blackbody_colours().surface(kTemperature);
    const auto unit = static_cast<float>(1 / blackbody_xyz(kTemperature).y);
    return WorkingRgb{c.r * unit, c.g * unit, c.b * unit};
  }();
  const double blur = std::exp(-pi * pi * width * width / 6);
  const double wave = std::cos(2 * pi * (phase - std::round(phase)));
  const auto k = static_cast<float>((kLight + kDark) / 2 + (kLight - kDark) / 2 * wave * blur);
  return {colour.r * k, colour.g * k, colour.b * k};
}

}  // namespace domefall
