// The greatest value in a frame, by which a black one is known.
#pragma once

#include <atomic>
#include <filesystem>

#include "pipeline/image/encode/row_source.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// A frame is black if no value exceeds one code of 8 bits, in light or as a code.
inline constexpr double kBrightestOfBlack = 1.0 / 255 / 12.92;
inline constexpr double kBrightestOfBlackCodes = 1.0 / 255;

// The greatest absolute value; infinity where one is infinite or no number.
double brightest_value(const HalfFrame& frame);

// The same rows, which raise `brightest` to their greatest code as they are made.  Both must
// outlive the picture.
RowPicture watched(const RowPicture& picture, std::atomic<unsigned short>& brightest);

// That of a file: of light for an .exr, else a code as a part of white, which is the greatest one if
// the frame is black and else the first that is found to exceed black.  Throws std::runtime_error
// where it cannot be decoded, and as RegularFile.
double brightest_in_file(const std::filesystem::path& path);

}  // namespace domefall
