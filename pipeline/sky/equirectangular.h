// Panoramas in the equirectangular projection, as images come.
#pragma once

#include "pipeline/image/frame_buffer.h"
#include "pipeline/sky/sky_map.h"

namespace domefall {

// A map from an image as SkyMap's constructor takes it.
SkyMap map_of_panorama(const FloatImage& equirectangular);

}  // namespace domefall
