// This is the ZIP compression of OpenEXR, packed by ISA-L.
#pragma once

#include <Imath/half.h>

#include <string_view>

#include "pipeline/image/encode/deflate.h"

namespace domefall {

class ExrZip {
 public:
  // Packs a block of rows rgb[height][width][3] as it stands in a file of channels B, G, R.  It is
  // a zlib stream of the bytes' differences ("OpenEXR File Layout"), or the bytes as they are where
  // that would be no smaller.  The bytes are there until the next block.
  std::string_view pack(const Imath::half* rgb, int width, int height);
  std::string_view pack(const float* rgb, int width, int height);

 private:
  template <class T>
  std::string_view pack_words(const T* rgb, int width, int height);

  Deflater deflater_;
  ByteBlock bytes_, packed_;
};

}  // namespace domefall
