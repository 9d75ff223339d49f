// Sky maps from files of any format OpenImageIO reads.
#pragma once

#include <filesystem>

#include "pipeline/image/frame_buffer.h"

namespace domefall {

// Linear-light RGB.  Integer files (8 or 16 bits) are taken as sRGB-encoded, float files as linear;
// grey is spread to RGB, further channels are dropped.  Throws InputError naming the file if it
// cannot be read to its end, is too large (over 32768 pixels a side) or holds a pixel that is not
// finite.
FloatImage read_image(const std::filesystem::path& file);

}  // namespace domefall
