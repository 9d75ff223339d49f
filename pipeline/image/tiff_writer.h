// This file writes TIFF files of 8 or 16 bits, in RGB without alpha, packed by deflate.
#pragma once

#include <string>

#include "pipeline/image/encode/byte_sink.h"
#include "pipeline/image/encode/row_source.h"

namespace domefall {

struct TiffHead {
  bool eight_bits = false;  // dithered (dither.h)
  int frame = 0;            // for the noise
  std::string description;
  std::string profile;  // ICC; empty for none
};

// Writes the whole file, on several threads (side_by_side.h).  The bytes depend on the rows and the
// head alone.  Throws as begin_tiff(), and std::runtime_error for a part that libtiff cannot write.
void write_tiff(ByteSink& sink, const RowPicture& picture, const TiffHead& head);

}  // namespace domefall
