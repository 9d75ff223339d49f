// What a frame's pixels are in OpenEXR, and what packs them without changing them.
#pragma once

namespace domefall {

// Blocks of 16 rows, blocks of 1 row, 32 rows by wavelets, or the pixels as they are.
enum class ExrCompression { kZip, kZips, kPiz, kNone };

// Floats of 16 or 32 bits.
enum class ExrPixels { kHalf, kFloat };

struct ExrFormat {
  ExrPixels pixels = ExrPixels::kHalf;
  ExrCompression compression = ExrCompression::kZip;
};

}  // namespace domefall
