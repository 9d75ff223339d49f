// This file tells the formats of pictures apart by their first bytes.
//
// OpenImageIO reads some thirty formats, picks one by the file's name, and tries all others where
// that one fails.  Some of its readers write beyond their memory when a file is damaged, or take
// minutes.  So a picture's bytes are shown to the one reader that is named here, and to no other.
#pragma once

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

// Says whether the attributes in the header of an OpenEXR file, as far as `start` shows them, are
// within a file of so many bytes.  OpenEXR takes memory for an attribute before it reads it.
bool exr_attributes_fit(std::string_view start, std::uint64_t file_bytes);

}  // namespace domefall
