// The light of a sky's background in a direction, and what a frequency ratio does to it.
#pragma once

#include "pipeline/render/scene/sky_store.h"

namespace domefall {

// Light of a sky's background (cd/m^2, times `scale`) at frequency ratio
// g = 1/(1+z), filtered over `footprint` radians on the sky, with the show's effects but its
// amplification.  [Riazuelo] sec. ssec_rgb for panoramas, which have no spectrum to shift.
WorkingRgb background_light(const Sky& sky, const Show& show, const V3d& sky_direction,
                            double footprint, double g, double scale);

// What SkySampler makes of the same: the factor on a map's values, and the octaves by which the
// temperatures of a thermal one are raised.
struct MapShift {
  float gain, tone;
};
MapShift map_shift(const SkyMap& map, const Show& show, double g, double scale);

// A panorama's law has a knee at g = 1.  Its two sides for any g, each smooth: for interpolation.
// `red` is above knee(map, scale) where g > 1, and there `blue` holds.
struct ShiftSides {
  float red, blue;
};
ShiftSides shift_sides(const SkyMap& map, const Show& show, double g, double scale);

// Both for many at a time, `count` <= kMostShifts: the same bits.
inline constexpr int kMostShifts = 128;
void map_shifts(const SkyMap& map, const Show& show, const double* g, int count, double scale,
                float* gain, float* tone);
void shift_sides(const SkyMap& map, const Show& show, const double* g, int count, double scale,
                 float* red, float* blue);

inline float knee(const SkyMap& map, double scale) {
  return static_cast<float>(map.unit() * scale);
}

// Null unless the background is a map.
inline const SkyMap* map_of(const Sky* sky) {
  if (sky == nullptr) return nullptr;
  const auto* map = std::get_if<std::shared_ptr<const SkyMap>>(&sky->background);
  return map ? map->get() : nullptr;
}

}  // namespace domefall
