// This file writes OpenEXR files of scan lines.  The channels are R, G and B or others, in floats
// of 16 or 32 bits.
#pragma once

#include <Imath/half.h>

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pipeline/image/encode/byte_sink.h"
#include "pipeline/image/encode/exr_compression.h"

namespace domefall {

// ExrChromaticities are CIE x, y of red, green, blue and white.
struct ExrChromaticities {
  float xy[8];
};
struct ExrRational {
  int numerator;
  unsigned denominator;
};
struct ExrTimeCode {
  unsigned time_and_flags;  // as SMPTE ST 12-1 packs them for television of 60 fields
};

using ExrValue =
    std::variant<std::string, int, double, ExrChromaticities, ExrRational, ExrTimeCode>;

struct ExrPicture {
  int width = 0, height = 0;
  // The pixels are [height][width][number of channels].
  std::variant<const Imath::half*, const float*> pixels{};
  ExrCompression compression = ExrCompression::kZip;
  std::vector<std::pair<std::string, ExrValue>> attributes;  // beside those of every file
  std::vector<std::string> channels{"R", "G", "B"};          // each name once, in pixels' order
};

// Writes the whole file, on several threads (side_by_side.h).  The bytes depend on the picture
// alone.  Throws std::runtime_error with OpenEXR's reason.
void write_exr(ByteSink& sink, const ExrPicture& picture);

}  // namespace domefall
