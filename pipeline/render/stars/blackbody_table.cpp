#include "pipeline/render/stars/blackbody_table.h"

#include <algorithm>

#include "pipeline/sources/colour/blackbody.h"

namespace domefall {
namespace {

// The table covers this range, in kelvin.
constexpr double kFirstTemperature = 512, kLastTemperature = 0x1p26;

BlackbodyTable::Light light_at(double temperature) {
  const WorkingRgb c = blackbody_colours().per_flux(temperature);
  return {c.r, c.g, c.b, static_cast<float>(luminance(c))};
}

}  // namespace

BlackbodyTable::BlackbodyTable()
    : first_(std::bit_cast<std::uint64_t>(kFirstTemperature) >> kShift) {
  const std::uint64_t last = std::bit_cast<std::uint64_t>(kLastTemperature) >> kShift;
  for (std::uint64_t key = first_; key <= last; ++key)
    lights_.push_back(light_at(std::bit_cast<double>(key << kShift)));
  // The luminance of a unit of flux is largest near 6600 K.  The nodes of the table are 0.1 per
  // cent apart there, so that the largest value in the table is within 1e-5 of the maximum.
  for (const Light& light : lights_) most_ = std::max(most_, double{light.luminance});
  most_ *= 1 + 1e-5;
}

BlackbodyTable::Light BlackbodyTable::beyond_table(double temperature) {
  return light_at(temperature);
}

const BlackbodyTable& blackbody_table() {
  static const BlackbodyTable table;
  return table;
}

}  // namespace domefall
