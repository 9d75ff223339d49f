// This file reads sky maps from pictures.
#pragma once

#include <filesystem>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

// Returns linear-light RGB.  Integer files (8 or 16 bits) are taken as sRGB-encoded, float files as
// linear.  Grey is spread to RGB, and further channels are dropped.  Throws as InputImage, and
// InputError naming the file if it cannot be read to its end or holds a pixel that is not finite.
FloatImage read_image(const std::filesystem::path& file);

}  // namespace domefall
