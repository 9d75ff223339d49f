#include "pipeline/sources/sky/formula_sky.h"

#include <cmath>
#include <numbers>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

constexpr double kCell = 5 * std::numbers::pi / 180;
constexpr double kPolarRadius = kCell / 2;
constexpr double kSquareTemperature = 8000, kPolarTemperature = 2000;
// Luminances (cd/m^2) are those at no redshift.  A light square is as bright as the heart of the
// Milky Way.
constexpr double kLightSquare = 4e-4, kDarkSquare = kLightSquare / 4, kPolarDisc = 8e-4;

// The sum rounds to a whole number, and the difference is exact (vector_math.h).
double nearest_whole(double x) { return (x + kRounding) - kRounding; }

// Returns the mean, over a box of this width about x, of the square wave that is 1 on [0, 1) and -1
// on [1, 2).  The integral of the wave from 0 to x is the distance from x to the nearest even
// number, so the mean is a difference of two such distances over the width.
double box_filtered_wave(double x, double width) {
  const double above = x + width / 2, below = x - width / 2;
  const double to_above = above - 2 * nearest_whole(above / 2),
               to_below = below - 2 * nearest_whole(below / 2);
  return (std::abs(to_above) - std::abs(to_below)) / width;
}

double to_square_border(double angle) {
  return std::abs(angle - kCell * nearest_whole(angle / kCell));
}

// This loop is compiled once for each instruction set (dispatch.h), and so it selects and does not
// branch.
[[gnu::always_inline]] inline void grid_lights_loop(const GridPlaces& places, int count,
                                                    const GridLights& lights) {
  const GridPlaces at = places;
  const GridLights to = lights;
  constexpr double kMean = (kLightSquare + kDarkSquare) / 2,
                   kSwing = (kLightSquare - kDarkSquare) / 2;
  for (int k = 0; k < count; ++k) {
    const double across = std::sqrt(at.x[k] * at.x[k] + at.y[k] * at.y[k]);
    const double right_ascension = arc_tangent2(at.y[k], at.x[k]),
                 declination = arc_tangent2(at.z[k], across);
    const double from_disc = std::numbers::pi / 2 - kPolarRadius - std::abs(declination);
    // The box must have some width, since the mean divides by it.
    const double width = at.footprint[k] > 1e-9 ? at.footprint[k] : 1e-9;
    // The disc's edge is blurred over the footprint.  A disc fills only a share of a wider
    // footprint.
    const double whole = kCell * kCell / (width * width), share = whole < 1 ? whole : 1;
    const double within = 0.5 - from_disc / width,
                 bounded = within < 0   ? 0
                           : within > 1 ? 1
                                        : within,
                 disc = share * bounded;
    // A footprint covers an angle of right ascension that grows as 1/cos(declination) towards the
    // poles.
    const double columns =
        box_filtered_wave(right_ascension / kCell, width / kCell / (across > 1e-6 ? across : 1e-6));
    const double rows = box_filtered_wave(declination / kCell, width / kCell);
    to.squares[k] = static_cast<float>((kMean + kSwing * columns * rows) * (1 - disc));
    to.discs[k] = static_cast<float>(kPolarDisc * disc);
    // The circle of declination through the place has the radius `across`.  The arc along it to the
    // next meridian is longer than the shortest way there, but only by a small part of a reach
    // wherever squares can be resolved.
    const double reach = at.reach[k];
    const int in_square = int{to_square_border(declination) >= reach} &
                          int{to_square_border(right_ascension) * across >= reach};
    const int even = int{std::abs(from_disc) >= reach} & (int{from_disc < 0} | in_square);
    to.even[k] = static_cast<float>(even);
  }
}
Dispatched<grid_lights_loop> grid_lights_by_set;

constexpr double kRingTemperature = 3000;

// Returns the mean luminance over a footprint, which blurs the cosine.
inline double ring_luminance(double phase, double width) {
  using std::numbers::pi;
  const double blur = exponential(-pi * pi * width * width / 6);
  // The cosine repeats, so whole turns are taken off, which keeps its argument small.
  const double turn = phase - ((phase + kRounding) - kRounding);
  return (kLightSquare + kDarkSquare) / 2 +
         (kLightSquare - kDarkSquare) / 2 * sin_cos(2 * pi * turn).cosine * blur;
}

[[gnu::always_inline]] inline void ring_lights_loop(const float* phase, const float* width,
                                                    int count, float* luminance) {
  for (int k = 0; k < count; ++k)
    luminance[k] = static_cast<float>(ring_luminance(phase[k], width[k]));
}
Dispatched<ring_lights_loop> ring_lights_by_set;

}  // namespace

WorkingRgb grid_colour(const GridLight& light, double g) {
  // `surface` gives the light of a full surface.  These factors bring its luminance to 1 where g =
  // 1.
  static const double square_scale = 1 / blackbody_xyz(kSquareTemperature).y;
  static const double disc_scale = 1 / blackbody_xyz(kPolarTemperature).y;
  WorkingRgb sum{0, 0, 0};
  const auto add = [&](double luminance, double temperature) {
    const WorkingRgb c = blackbody_colours().surface(temperature * g);
    const auto k = static_cast<float>(luminance);
    sum = {sum.r + c.r * k, sum.g + c.g * k, sum.b + c.b * k};
  };
  if (light.squares > 0) add(light.squares * square_scale, kSquareTemperature);
  if (light.discs > 0) add(light.discs * disc_scale, kPolarTemperature);
  return sum;
}

GridLight grid_light(const SkyDirection& direction, double footprint) {
  const V3d& d = direction.v;
  const double no_reach = 0;
  GridLight light{};
  float even = 0;
  grid_lights({&d.x, &d.y, &d.z, &footprint, &no_reach}, 1, {&light.squares, &light.discs, &even});
  return light;
}

void grid_lights(const GridPlaces& places, int count, const GridLights& lights) {
  grid_lights_by_set(places, count, lights);
}

WorkingRgb ring_colour() {
  static const WorkingRgb colour = [] {
    const WorkingRgb c = blackbody_colours().surface(kRingTemperature);
    // Y is the luminance of a full surface, so that the colour's own becomes 1.
    const auto unit = static_cast<float>(1 / blackbody_xyz(kRingTemperature).y);
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
