#include "pipeline/image/openimageio/picture_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
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

// A list of channels is a row of names, each followed by a 0 and 16 bytes, of which the last eight
// say that each so many columns, and rows, have a sample.  Some versions of OpenImageIO call
// luminance and chroma R, G and B.
void check_sampling(std::string_view channels) {
  constexpr std::size_t kRest = 16;
  for (std::size_t at = 0; at < channels.size() && channels[at] != 0;) {
    const std::size_t end = channels.find('\0', at);
    if (end == std::string_view::npos || channels.size() - end <= kRest) return;
    const std::string_view name = channels.substr(at, end - at);
    if (name == "RY" || name == "BY" || little_endian(channels, end + 9, 4) != 1 ||
        little_endian(channels, end + 13, 4) != 1)
      throw std::runtime_error(
          "its colours are stored as luminance and chroma (Y, RY, BY), or with fewer pixels than "
          "others; convert it to RGB");
    at = end + 1 + kRest;
  }
}

// A tile may have this many bytes, because OpenImageIO holds a whole tile at once.
constexpr std::uint64_t kLargestTile = std::uint64_t{1} << 28;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

// Returns the most pixels that a byte of the file can stand for.  A pixel has a bit at least before
// it is packed, and deflate makes at most 1032 bytes of one (its longest match is 258 bytes in 2
// bits).
double most_pixels_per_byte(std::string_view format, std::string_view packing) {
  constexpr double kBits = 8, kRuns = 64, kDeflate = 1032, kLzw = 2731, kOther = 65536;
  if (format == "hdr") return kRuns;  // two bytes say that 127 are the same
  // A JPEG spends a bit on 64 pixels, or with arithmetic coding somewhat less.
  if (format == "png" || format == "jpeg") return kDeflate * kBits;
  if (format == "webp") return kMostPixels;  // a picture of one colour takes no bits
  if (packing == "none") return kBits;
  if (packing == "rle" || packing == "packbits") return kRuns * kBits;
  if (packing == "lzw") return kLzw * kBits;
  if (packing == "zip" || packing == "zips") return kDeflate * kBits;
  return kOther * kBits;
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
void check_exr_header(std::string_view start, std::uint64_t file_bytes) {
  constexpr std::size_t kHeader = 8, kLength = 4;
  const bool parts = little_endian(start, 4, 4) & 0x1000;
  for (std::size_t at = kHeader; at < start.size();) {
    if (start[at] == 0) {
      if (!parts || at + 1 >= start.size() || start[at + 1] == 0) return;
      ++at;
      continue;
    }
    const std::size_t name = start.find('\0', at);
    const std::size_t type = name == std::string_view::npos ? name : start.find('\0', name + 1);
    if (type == std::string_view::npos || start.size() - type <= kLength)
      return;  // start ends here
    const auto length = static_cast<std::uint64_t>(little_endian(start, type + 1, kLength));
    const std::string_view attribute = start.substr(name + 1, type - name - 1);
    at = type + 1 + kLength;
    if (length > file_bytes - std::min<std::uint64_t>(file_bytes, at))
      throw std::runtime_error("the file ends within its header, or the header is wrong");
    if (attribute == "chlist") check_sampling(start.substr(at, static_cast<std::size_t>(length)));
    at += static_cast<std::size_t>(length);
  }
}

std::optional<PictureSize> stated_size(std::string_view format, std::string_view start) {
  if (format == "jpeg") return jpeg_size(start);
  if (format == "webp") return webp_size(start);
  return std::nullopt;
}

void check_side(std::int64_t width, std::int64_t height) {
  const std::string size = fmt::format("{} x {}", width, height);
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    fail(fmt::format("the image must be 1 to {} pixels a side, got {}", kLargestSide, size));
  if (static_cast<std::uint64_t>(width * height) > kMostPixels)
    fail("the image has more than 32768 x 16384 pixels: " + size);
}

void check_size(std::int64_t width, std::int64_t height, std::string_view format,
                std::string_view packing, std::uint64_t file_bytes) {
  check_side(width, height);
  const std::string size = fmt::format("{} x {}", width, height);
  const double most = most_pixels_per_byte(format, packing) * static_cast<double>(file_bytes);
  if (static_cast<double>(width * height) > most)
    fail(
        fmt::format("the file is cut short, or its header is wrong: {} bytes cannot hold {} pixels",
                    file_bytes, size));
}

void check_picture(std::string_view format, const OIIO::ImageSpec& spec, std::uint64_t file_bytes) {
  check_size(spec.width, spec.height, format, spec.get_string_attribute("compression", "none"),
             file_bytes);
  if (spec.depth > 1 || spec.deep) fail("the image is a volume or has deep pixels");
  if (spec.nchannels < 1 || spec.nchannels > kMostChannels)
    fail(
        fmt::format("the image must have 1 to {} channels, got {}", kMostChannels, spec.nchannels));
  if (spec.tile_width > 0 && (spec.tile_width > kLargestSide || spec.tile_height > kLargestSide ||
                              spec.tile_bytes(true) > kLargestTile))
    fail(fmt::format("the image is stored in tiles of {} x {} pixels; they may have 256 MiB",
                     spec.tile_width, spec.tile_height));
}

}  // namespace domefall
