#include "pipeline/sources/stars/star_granulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline/base/lattice_key.h"

namespace domefall {
namespace {

// Calls use(distance^2, key) for the points next to a place, of one in each cell of a lattice in space.
template <class Use>
void for_points(const V3d& at, std::uint32_t seed, const Use& use) {
  const double x = std::floor(at.x), y = std::floor(at.y), z = std::floor(at.z);
  for (int k = 0; k < 27; ++k) {
    const int row = k / 3 % 3, layer = k / 9;
    const double i = x + k % 3 - 1, j = y + row - 1, l = z + layer - 1;
    const auto number = [](double cell) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(cell));
    };
    const std::uint32_t key = lattice_key(lattice_key(seed ^ number(i), number(j)), number(l));
    const auto part = [key](int bits) { return ((key >> bits) & 1023u) / 1024.0; };
    const double dx = i + part(0) - at.x, dy = j + part(10) - at.y, dz = l + part(20) - at.z;
    use(dx * dx + dy * dy + dz * dz, key);
  }
}

// From 0 to 1.
double own(std::uint32_t key) { return static_cast<double>(mixed(key) >> 8) * 0x1p-24; }

// Granules are cells of brightnesses of their own and have dark lanes between them.  The sphere of
// granulation() has the mean 0, and the standard deviation is 1.
double granules(const V3d& at) {
  constexpr double kLane = 0.5, kMean = 0.3739, kDeviation = 0.2438;
  double first = HUGE_VAL, second = HUGE_VAL, brightness = 0;
  for_points(at, 1, [&](double distance2, std::uint32_t key) {
    if (distance2 < first)
      second = first, first = distance2, brightness = own(key);
    else if (distance2 < second)
      second = distance2;
  });
  const double in = std::min((std::sqrt(second) - std::sqrt(first)) / kLane, 1.0);
  return ((0.4 + 0.6 * brightness) * in * (2 - in) - kMean) / kDeviation;
}

// A smooth noise, likewise.
double mottling(const V3d& at) {
  constexpr double kMean = -0.0087, kDeviation = 0.1543;
  double sum = -kMean;
  for_points(at, 2, [&](double distance2, std::uint32_t key) {
    const double left = std::max(1 - distance2, 0.0);
    sum += (own(key) - 0.5) * left * left * left;
  });
  return sum / kDeviation;
}

// Returns the part of the contrast that is left in light of this width, in cells.
double left_in(double width) {
  constexpr double kAll = 0.1, kNone = 0.55;
  const double t = std::clamp((kNone - width) / (kNone - kAll), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

double granulation(const V3d& place, double width, double contrast) {
  constexpr double kMottlingContrast = 0.25;  // of the granules'
  double light = 1;
  if (const double part = left_in(width / kGranule); part > 0)
    light += contrast * part * granules(place / kGranule);
  if (const double part = left_in(width / kMottling); part > 0)
    light += contrast * kMottlingContrast * part * mottling(place / kMottling);
  return light;
}

}  // namespace domefall
