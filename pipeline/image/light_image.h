// A LightImage is a large picture, held as half floats.  A panorama of 16384 x 8192 takes 0.8 GB.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

enum class PixelEncoding {
  kOfFile,  // integers are sRGB, floats are linear
  kLinear,
  kSrgb,  // IEC 61966-2-1
};

// Colours are linear RGB, and a pixel's value is `unit` times its half.
struct LightImage {
  ImageRgb<Imath::half> pixels;
  double unit = 1;
};

// Reads a file of a format and size that InputImage takes, by bands of rows or tiles.  Grey is
// spread to RGB, further channels are dropped, and what is negative becomes 0.  Throws as
// InputImage, and InputError naming the file if it cannot be read to its end, holds a pixel that is
// not finite, or has negative values and none above 0.
LightImage read_light_image(const std::filesystem::path& file, PixelEncoding encoding);

}  // namespace domefall
