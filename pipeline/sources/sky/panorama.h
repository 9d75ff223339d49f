// Panoramas, which are images in the equirectangular projection, are made into colour maps.
#pragma once

#include "pipeline/image/frame_buffer.h"
#include "pipeline/image/read_image.h"
#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/sky/orientation.h"
#include "pipeline/sources/sky/sky_map.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {

// A pixel value of 1 in a panorama's file stands for this luminance (cd/m^2).
inline constexpr double kPanoramaUnit = 1e-4;

// Makes a map from an image in linear RGB, equatorial J2000 and seen from inside: the middle
// column is RA 0h, RA grows to the left, and the top row is Dec +90.  The image is twice as wide as
// it is high, and at least 4 x 2.  The faces of the map have at most `largest_face` texels along an
// edge, and at most 4096.  If the image has more detail than that, means of its pixels are painted.
// The matrix takes its RGB to the working space, where what is negative becomes 0.
SkyMap map_of_panorama(const FloatImage& image, int largest_face = kLargestFace,
                       const ColourMatrix& to_working = working_from_rec709());

// Returns the number of texels along a face that keep the detail of an image of this width, at most
// 4096.  A texel is half as wide as a pixel of the image, so that samples, which are linear between
// texels, stay smooth.
int panorama_face(int width);

// Returns the unit (sky_unit) of a colour map of an image whose value 1 stands for `luminance`
// cd/m^2.
double panorama_unit(const LightImage& image, double luminance);

// Sets the finest level of such a map, including its border.  If the level is coarser than the
// image's pixels, its texels are means of several samples.
void paint_panorama(const LightImage& image, const Orientation& orientation, double luminance,
                    const SkyPyramid& pyramid);

}  // namespace domefall
