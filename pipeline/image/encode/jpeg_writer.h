// This file writes JPEG files of 8 bits, whose colours are as fine as their light (4:4:4).
#pragma once

#include <string>

#include "pipeline/image/encode/byte_sink.h"
#include "pipeline/image/encode/row_source.h"

namespace domefall {

// A comment holds at most this many bytes.
inline constexpr std::size_t kLongestJpegComment = 65533;

struct JpegHead {
  int quality = 95;     // 1 to 100, libjpeg's scale
  int frame = 0;        // for the noise of the dithering (dither.h)
  std::string profile;  // ICC; empty for none
  std::string comment;  // of at most kLongestJpegComment bytes
};

// Writes the whole file.  The rows come from several threads (side_by_side.h) and are packed by
// one, since each begins where the one before has ended.  The bytes depend on the rows and the head
// alone.  Throws std::runtime_error with libjpeg's reason.
void write_jpeg(ByteSink& sink, const RowPicture& picture, const JpegHead& head);

}  // namespace domefall
