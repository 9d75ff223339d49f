#include "pipeline/image_formats/picture_format.h"

#include <algorithm>
#include <array>
#include <utility>

namespace domefall {
namespace {

using namespace std::literals;

// Each is the whole of what its standard asks of the first bytes.
constexpr std::array kStarts{
    std::pair{"v/1\1"sv, "openexr"sv},     std::pair{"\x89PNG\r\n\x1a\n"sv, "png"sv},
    std::pair{"II*\0"sv, "tiff"sv},        std::pair{"MM\0*"sv, "tiff"sv},
    std::pair{"II+\0"sv, "tiff"sv},        std::pair{"MM\0+"sv, "tiff"sv},  // BigTIFF
    std::pair{"\xff\xd8\xff"sv, "jpeg"sv}, std::pair{"#?RADIANCE"sv, "hdr"sv},
    std::pair{"#?RGBE"sv, "hdr"sv},
};

// Returns the number in `count` bytes at `place`, the least significant first.  Bytes beyond the
// end count as 0.
std::int64_t little_endian(std::string_view bytes, std::size_t place, std::size_t count) {
  std::int64_t value = 0;
  for (std::size_t k = count; k-- > 0;)
    value =
        value << 8 | (place + k < bytes.size() ? static_cast<unsigned char>(bytes[place + k]) : 0);
  return value;
}

std::int64_t big_endian(std::string_view bytes, std::size_t place) {
  const std::int64_t value = little_endian(bytes, place, 2);
  return value >> 8 | (value & 0xff) << 8;
}

// By ITU-T T.81, B.1, a file has segments, each with a marker and a length, up to the frame header
// (SOF), which states the size.
std::optional<PictureSize> jpeg_size(std::string_view start) {
  std::size_t at = 2;
  while (at + 9 <= start.size()) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(start[at + k]); };
    const unsigned marker = byte(1);
    if (byte(0) != 0xff) {  // libjpeg passes over bytes that belong to no segment
      ++at;
    } else if (marker == 0xff || marker == 0 || marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;  // has no length
    } else if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 &&
               marker != 0xcc) {
      return PictureSize{big_endian(start, at + 7), big_endian(start, at + 5)};
    } else if (marker == 0xd9 || marker == 0xda) {
      return std::nullopt;
    } else {
      at += 2 + static_cast<std::size_t>(big_endian(start, at + 2));
    }
  }
  return std::nullopt;
}

// By RFC 9649 the first chunk says how large the picture, or the canvas of an animation, is.
std::optional<PictureSize> webp_size(std::string_view start) {
  constexpr std::size_t kChunk = 12, kData = 20;
  const std::string_view name = start.substr(kChunk, 4);
  if (name == "VP8X")
    return PictureSize{little_endian(start, kData + 4, 3) + 1,
                       little_endian(start, kData + 7, 3) + 1};
  if (name == "VP8 ")
    return PictureSize{little_endian(start, kData + 6, 2) & 0x3fff,
                       little_endian(start, kData + 8, 2) & 0x3fff};
  if (name != "VP8L") return std::nullopt;
  const std::int64_t bits = little_endian(start, kData + 1, 4);
  return PictureSize{(bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1};
}

}  // namespace

std::string_view picture_format(std::string_view start) {
  for (const auto& [bytes, format] : kStarts)
    if (start.starts_with(bytes)) return format;
  if (start.starts_with("RIFF") && start.size() >= 12 && start.substr(8, 4) == "WEBP")
    return "webp";
  return {};
}

// In the layout of OpenEXR files, headers follow the magic number and the version.  Each is a row
// of attributes (name, 0, type, 0, length in 4 bytes, value) and a 0.  A file of several parts has
// a header for each, and another 0 after them.
bool exr_attributes_fit(std::string_view start, std::uint64_t file_bytes) {
  constexpr std::size_t kHeader = 8, kLength = 4;
  const bool parts = little_endian(start, 4, 4) & 0x1000;
  for (std::size_t at = kHeader; at < start.size();) {
    if (start[at] == 0) {
      if (!parts || at + 1 >= start.size() || start[at + 1] == 0) return true;
      ++at;
      continue;
    }
    const std::size_t name = start.find('\0', at);
    const std::size_t type = name == std::string_view::npos ? name : start.find('\0', name + 1);
    if (type == std::string_view::npos || start.size() - type <= kLength)
      return true;  // start ends here
    const auto length = static_cast<std::uint64_t>(little_endian(start, type + 1, kLength));
    at = type + 1 + kLength;
    if (length > file_bytes - std::min<std::uint64_t>(file_bytes, at)) return false;
    at += static_cast<std::size_t>(length);
  }
  return true;
}

std::optional<PictureSize> stated_size(std::string_view format, std::string_view start) {
  if (format == "jpeg") return jpeg_size(start);
  if (format == "webp") return webp_size(start);
  return std::nullopt;
}

}  // namespace domefall
