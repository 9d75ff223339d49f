// These write graded pictures in RGB: PNG and TIFF files of 8 or 16 bits, which may have an alpha, not
// premultiplied, and JPEG files of 8 bits, whose colours are as fine as their light (4:4:4).  The rows come from several
// threads (side_by_side.h).  The bytes depend on the rows and the head alone.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/new_file.h"
#include "pipeline/image/encode/row_source.h"

namespace domefall {

struct PngChunk {
  std::string_view name;  // of four letters
  std::string data;
};

struct PngHead {
  bool eight_bits = false;       // dithered (dither.h)
  int frame = 0;                 // for the noise
  std::vector<PngChunk> chunks;  // before the pixels
  OpaqueColumns opaque{};        // without it there is no alpha
};

void write_png(ByteSink& sink, const RowPicture& picture, const PngHead& head);

// Returns pHYs, the sides of a pixel in an unknown unit, as so many pixels to it.
PngChunk png_pixel_aspect(double width_over_height);

// Returns a number as it stands in the file, big-endian.
std::string png_number(std::uint32_t number);

// Returns the CRC-32 of a PNG's chunk as it stands in the file.
std::string png_checksum(std::string_view name_and_data);

struct TiffHead {
  bool eight_bits = false;  // dithered (dither.h)
  int frame = 0;            // for the noise
  std::string description;
  std::string profile{};    // ICC; empty for none
  OpaqueColumns opaque{};   // without it there is no alpha
  double pixel_aspect = 1;  // width over height, as resolutions where it is not 1
};

// Throws std::runtime_error for a part that libtiff cannot write.
void write_tiff(ByteSink& sink, const RowPicture& picture, const TiffHead& head);

// A comment holds at most this many bytes.
inline constexpr std::size_t kLongestJpegComment = 65533;

struct JpegHead {
  int quality = 95;         // 1 to 100, libjpeg's scale
  int frame = 0;            // for the noise of the dithering (dither.h)
  std::string profile{};    // ICC; empty for none
  std::string comment{};    // of at most kLongestJpegComment bytes
  double pixel_aspect = 1;  // width over height, as the densities of JFIF
};

// The rows are packed by one thread, since each begins where the one before has ended.  Throws std::runtime_error with libjpeg's reason.
void write_jpeg(ByteSink& sink, const RowPicture& picture, const JpegHead& head);

}  // namespace domefall
