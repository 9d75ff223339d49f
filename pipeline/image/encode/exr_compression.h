// What OpenEXR packs a frame's pixels with, without changing them.
#pragma once

namespace domefall {

// Blocks of 16 rows, blocks of 1 row, 32 rows by wavelets, or the pixels as they are.
enum class ExrCompression { kZip, kZips, kPiz, kNone };

}  // namespace domefall
