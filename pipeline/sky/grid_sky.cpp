#include "pipeline/sky/grid_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/colour/blackbody.h"

namespace domefall {
namespace {

constexpr double kCell = 5 * std::numbers::pi / 180;
constexpr double kPolarRadius = kCell / 2;
constexpr double kSquareTemperature = 8000, kPolarTemperature = 2000;
// Luminance (cd/m^2) at no redshift: a light square is as bright as the heart of the Milky Way.
constexpr double kLightSquare = 4e-4, kDarkSquare = kLightSquare / 4, kPolarDisc = 8e-4;

// Returns the mean, over a box of this width about x, of the square wave that is 1 on [0, 1) and -1
// on [1, 2).
double box_filtered_wave(double x, double width) {
  const auto integral = [](double t) {
    const double phase = t - 2 * std::floor(t / 2);
    return phase < 1 ? phase : 2 - phase;
  };
  return (integral(x + width / 2) - integral(x - width / 2)) / width;
}

// A place on the grid, in radians; `across` is its distance from the axis through the poles.
struct GridPlace {
  double across, right_ascension, declination, to_pole;

  explicit GridPlace(const V3d& d)
      : across(std::sqrt(d.x * d.x + d.y * d.y)),
        right_ascension(std::atan2(d.y, d.x)),
        declination(std::atan2(d.z, across)),
        to_pole(std::numbers::pi / 2 - std::abs(declination)) {}
};

}  // namespace

WorkingRgb grid_light(const SkyDirection& direction, double footprint, double g) {
  static const double square_scale = 1 / blackbody_xyz(kSquareTemperature).y;
  static const double polar_scale = 1 / blackbody_xyz(kPolarTemperature).y;
  const GridPlace place(direction.v);
  const double width = std::max(footprint, 1e-9);
  // The disc's edge is blurred over the footprint.  Of a wider footprint it fills only a share.
  const double share = std::min(1.0, kCell * kCell / (width * width));
  const double disc = share * std::clamp((kPolarRadius - place.to_pole) / width + 0.5, 0.0, 1.0);
  WorkingRgb light{0, 0, 0};
  if (disc < 1) {
    const double columns = box_filtered_wave(place.right_ascension / kCell,
                                             width / kCell / std::max(place.across, 1e-6));
    const double rows = box_filtered_wave(place.declination / kCell, width / kCell);
    const double mean = (kLightSquare + kDarkSquare) / 2, swing = (kLightSquare - kDarkSquare) / 2;
    const auto k = static_cast<float>((mean + swing * columns * rows) * (1 - disc) * square_scale);
    const WorkingRgb c = blackbody_colours().surface(kSquareTemperature * g);
    light = {c.r * k, c.g * k, c.b * k};
  }
  if (disc > 0) {
    const auto k = static_cast<float>(kPolarDisc * disc * polar_scale);
    const WorkingRgb c = blackbody_colours().surface(kPolarTemperature * g);
    light = {light.r + c.r * k, light.g + c.g * k, light.b + c.b * k};
  }
  return light;
}

bool grid_is_even(const SkyDirection& direction, double reach) {
  const GridPlace place(direction.v);
  const double from_disc = place.to_pole - kPolarRadius;
  if (std::abs(from_disc) < reach) return false;
  if (from_disc < 0) return true;
  const auto to_border = [](double angle) {
    return std::abs(angle - kCell * std::round(angle / kCell));
  };
  // Of a small circle of declination `across` is the radius, so an angle along it is longer than
  // the way to the meridian, by a part of a reach that is small wherever a square resolves it.
  return to_border(place.declination) >= reach &&
         to_border(place.right_ascension) * place.across >= reach;
}

}  // namespace domefall
