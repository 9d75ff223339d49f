// Panoramas in the equirectangular projection, as images come.
#pragma once

#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/light_image.h"
#include "pipeline/sky/maps/orientation.h"
#include "pipeline/sky/maps/sky_map.h"
#include "pipeline/sky/maps/sky_pyramid.h"

namespace domefall {

// A map from an equirectangular image, linear Rec.709, equatorial J2000, seen from inside: the middle
// column is RA 0h, RA grows to the left, and the top row is Dec +90.  The image is twice as wide as it
// is high, and at least 4 x 2.
SkyMap map_of_panorama(const FloatImage& image);

// Texels along a face that keep the detail of an image of this width: half as fine as its pixels,
// so that bilinear looks between texels stay smooth.  At most 4096.
int panorama_face(int width);

// The unit for a colour map of the image, linear Rec.709, whose value 1 is this luminance (cd/m^2).
double panorama_unit(const LightImage& image, double luminance);

// The finest level of a colour map, border and all; a level coarser than panorama_face() has the
// means of finer looks.
void paint_panorama(const LightImage& image, const Orientation& orientation, double luminance,
                    const SkyPyramid& pyramid);

}  // namespace domefall
