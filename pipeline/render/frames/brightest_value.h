// A black frame is known by the greatest value in it.
#pragma once

#include <atomic>
#include <filesystem>

#include "pipeline/image/encode/row_source.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// A frame is black if no value exceeds one code of 8 bits, in light or as a code.
inline constexpr double kBrightestOfBlack = 1.0 / 255 / 12.92;
inline constexpr double kBrightestOfBlackCodes = 1.0 / 255;

// Returns the greatest absolute value, which is infinity where one is infinite or no number.
double brightest_value(const HalfFrame& frame);

// Returns the same rows, which raise `brightest` to their greatest code as they are made.  Both
// must outlive the picture.
RowPicture watched(const RowPicture& picture, std::atomic<unsigned short>& brightest);

// Returns the brightest value of a file.  For an .exr this is its greatest absolute value, as
// above.  Other files hold codes, which count as parts of white.  They are read until a code
// exceeds black, and the greatest code so far is returned.  Throws std::runtime_error if the file
// cannot be decoded, and as RegularFile.
double brightest_in_file(const std::filesystem::path& path);

}  // namespace domefall
