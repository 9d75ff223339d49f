// This file writes OpenEXR files of scan lines.  Each channel has floats of 16 or 32 bits.
#pragma once

#include <Imath/half.h>

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pipeline/base/new_file.h"

namespace domefall {

// These pack blocks of 16 rows, blocks of 1 row, 32 rows by wavelets, or leave the pixels as they
// are.
enum class ExrCompression { kZip, kZips, kPiz, kNone };

// Floats have 16 or 32 bits.
enum class ExrPixels { kHalf, kFloat };

struct ExrFormat {
  ExrPixels pixels = ExrPixels::kHalf;
  ExrCompression compression = ExrCompression::kZip;
};

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

// An ExrMatrix multiplies rows of four numbers from the left, as Imath's matrices do.
struct ExrMatrix {
  float rows[16];
};

using ExrValue =
    std::variant<std::string, int, double, ExrChromaticities, ExrRational, ExrTimeCode, ExrMatrix>;

// A channel has one number for each pixel, row after row from the top, or null where all are 0.
struct ExrChannel {
  std::string name;
  std::variant<const Imath::half*, const float*> numbers{};
  std::ptrdiff_t step = 1;  // from one number to the next
};

// Returns the channels of a picture whose pixels hold the numbers of all channels side by side, or
// are null.
template <class T>
std::vector<ExrChannel> interleaved(const std::vector<std::string>& names, const T* pixels) {
  std::vector<ExrChannel> channels;
  channels.reserve(names.size());
  for (const std::string& name : names)
    channels.push_back(
        {name, pixels ? pixels++ : nullptr, static_cast<std::ptrdiff_t>(names.size())});
  return channels;
}

struct ExrPicture {
  int width = 0, height = 0;
  std::vector<ExrChannel> channels{};  // of different names, in any order
  ExrCompression compression = ExrCompression::kZip;
  std::vector<std::pair<std::string, ExrValue>> attributes{};  // beside those of every file
  double pixel_aspect = 1;                                     // width over height
};

// Writes the whole file, on several threads (side_by_side.h).  The bytes depend on the picture
// alone.  Throws std::runtime_error with OpenEXR's reason.
void write_exr(ByteSink& sink, const ExrPicture& picture);

}  // namespace domefall
