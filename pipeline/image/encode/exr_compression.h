// This file says what a frame's pixels are in OpenEXR, and what packs them without changing them.
#pragma once

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

}  // namespace domefall
