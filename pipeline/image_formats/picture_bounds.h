// This file bounds what the header of a picture may say.  It is checked before memory is taken for
// the pixels.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <string_view>

namespace domefall {

// The largest panorama has 32768 x 16384 pixels.  Along its horizon these are as many as around a
// cube whose faces have 8192 pixels, the most that a sky's map takes (sky_map.h).
inline constexpr int kLargestSide = 32768;
inline constexpr std::uint64_t kMostPixels = std::uint64_t{32768} * 16384;
inline constexpr int kMostChannels = 64;

// Throws std::runtime_error with the bound that a size exceeds, or if a file of so many bytes
// cannot hold so many pixels, however well they are packed.  `packing` is what OpenImageIO calls
// the compression.  It matters in TIFF and OpenEXR, which have several.
void check_size(std::int64_t width, std::int64_t height, std::string_view format,
                std::string_view packing, std::uint64_t file_bytes);

// Checks all that an opened picture says of itself, which is its size, its channels and how it is
// stored.  Throws as above.
void check_picture(std::string_view format, const OIIO::ImageSpec& spec, std::uint64_t file_bytes);

}  // namespace domefall
