#include "pipeline/image_formats/picture_bounds.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace domefall {
namespace {

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

void check_size(std::int64_t width, std::int64_t height, std::string_view format,
                std::string_view packing, std::uint64_t file_bytes) {
  const std::string size = fmt::format("{} x {}", width, height);
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    fail(fmt::format("the image must be 1 to {} pixels a side, got {}", kLargestSide, size));
  if (static_cast<std::uint64_t>(width * height) > kMostPixels)
    fail("the image has more than 32768 x 16384 pixels: " + size);
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
