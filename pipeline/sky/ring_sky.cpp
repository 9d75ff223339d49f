#include "pipeline/sky/ring_sky.h"

#include <numbers>

#include "pipeline/colour/blackbody.h"
#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/vector_math.h"

namespace domefall {
namespace {

using std::numbers::pi;

// ring_sky.h gives the temperature.  The luminances are those of the grid's squares (grid_sky.cpp).
constexpr double kTemperature = 3000;
constexpr double kLight = 4e-4, kDark = kLight / 4;  // cd/m^2

// Returns the mean luminance over a footprint, which blurs the cosine.
inline double ring_luminance(double phase, double width) {
  const double blur = exponential(-pi * pi * width * width / 6);
  // The cosine repeats, so whole turns are taken off, which keeps its argument small.
  const double turn = phase - ((phase + kRounding) - kRounding);
  return (kLight + kDark) / 2 + (kLight - kDark) / 2 * sin_cos(2 * pi * turn).cosine * blur;
}

// This loop is compiled once for each instruction set (dispatch.h).
[[gnu::always_inline]] inline void ring_lights_loop(const float* phase, const float* width,
                                                    int count, float* luminance) {
  for (int k = 0; k < count; ++k)
    luminance[k] = static_cast<float>(ring_luminance(phase[k], width[k]));
}
Dispatched<ring_lights_loop> ring_lights_by_set;

}  // namespace

WorkingRgb ring_colour() {
  static const WorkingRgb colour = [] {
    const WorkingRgb c = blackbody_colours().surface(kTemperature);
    // Y is the luminance of a full surface, so that the colour's own becomes 1.
    const auto unit = static_cast<float>(1 / blackbody_xyz(kTemperature).y);
    return WorkingRgb{c.r * unit, c.g * unit, c.b * unit};
  }();
  return colour;
}

WorkingRgb ring_glow(double phase, double width) {
  const WorkingRgb colour = ring_colour();
  const auto k = static_cast<float>(ring_luminance(phase, width));
  return {colour.r * k, colour.g * k, colour.b * k};
}

void ring_lights(const float* phase, const float* width, int count, float* luminance) {
  ring_lights_by_set(phase, width, count, luminance);
}

}  // namespace domefall
