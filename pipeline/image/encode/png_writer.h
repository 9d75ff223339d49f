// This file writes PNG files of 8 or 16 bits, in RGB without alpha.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/image/encode/byte_sink.h"
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
};

// Writes the whole file, on several threads (side_by_side.h).  The bytes depend on the rows and the
// head alone.
void write_png(ByteSink& sink, const RowPicture& picture, const PngHead& head);

// Returns the CRC-32 of a PNG's chunk, big-endian as it stands in the file.
std::string png_checksum(std::string_view name_and_data);

}  // namespace domefall
