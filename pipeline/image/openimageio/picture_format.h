// The formats of pictures, told apart by their first bytes, and bounds to what a header may say,
// which are checked before memory is taken for the pixels.
//
// OpenImageIO reads some thirty formats, picks one by the file's name, and tries all others where
// that one fails.  Some of its readers write beyond their memory when a file is damaged, or take
// minutes.  So a picture's bytes are shown to the one reader that is named here, and to no other.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <optional>
#include <string_view>

namespace domefall {

// Returns the name of OpenImageIO's reader for a file that begins with these bytes, of which 12 are
// needed.  It is "openexr", "png", "tiff", "jpeg", "hdr" (Radiance) or "webp", and empty for any
// other format.  Users read of them in kPictureFormats.
std::string_view picture_format(std::string_view start);

struct PictureSize {
  std::int64_t width = 0, height = 0;
};

// Returns the size that the header of a JPEG or WebP states, or nothing if `start` does not hold
// it.  OpenImageIO's readers of these two take memory for the whole picture as soon as they open
// it.  `start` are the file's first bytes, 1 MiB if there are so many.
std::optional<PictureSize> stated_size(std::string_view format, std::string_view start);

// Looks through the headers of an OpenEXR file of so many bytes, as far as `start` shows them.
// Throws std::runtime_error if an attribute is longer than the file, since OpenEXR takes memory for
// an attribute before it reads it, and if channels are stored with fewer pixels than others
// (luminance and chroma), of which some versions of OpenImageIO read nothing.
void check_exr_header(std::string_view start, std::uint64_t file_bytes);

// The largest panorama has 32768 x 16384 pixels.  Along its horizon these are as many as around a
// cube whose faces have 8192 pixels, the most that a sky's map takes (sky_map.h).
inline constexpr int kLargestSide = 32768;
inline constexpr std::uint64_t kMostPixels = std::uint64_t{32768} * 16384;
inline constexpr int kMostChannels = 64;

// Throws std::runtime_error with the bound that the size of a picture exceeds, however little of it
// is stored: memory is taken for all of it.
void check_side(std::int64_t width, std::int64_t height);

// Throws as check_side, or if a file of so many bytes
// cannot hold so many pixels, however well they are packed.  `packing` is what OpenImageIO calls
// the compression.  It matters in TIFF and OpenEXR, which have several.
void check_size(std::int64_t width, std::int64_t height, std::string_view format,
                std::string_view packing, std::uint64_t file_bytes);

// Checks all that an opened picture says of itself, which is its size, its channels and how it is
// stored.  Throws as above.
void check_picture(std::string_view format, const OIIO::ImageSpec& spec, std::uint64_t file_bytes);

}  // namespace domefall
