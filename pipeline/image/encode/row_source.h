// A RowPicture is made some rows at a time, so that it need not be in memory as a whole.
#pragma once

#include <functional>
#include <utility>

namespace domefall {

// Gives the rows first <= y < end of a picture as rgb[end - first][width][3], display-encoded, of
// 16 bits.  It is called from several threads at once, once for each row.
using RowSource = std::function<void(int first, int end, unsigned short* rgb)>;

// Says which columns first <= x < end of a row are opaque.
using OpaqueColumns = std::function<std::pair<int, int>(int row)>;

struct RowPicture {
  int width = 0, height = 0;
  RowSource rows;
};

// This is how many rows are made at once by one thread.  They are about half a megabyte, which
// stays in a processor's cache from the grade to the packing.
constexpr int rows_of_strip(int width, int height) {
  constexpr int kBytes = 1 << 19, kPixel = 3 * sizeof(unsigned short);
  const int rows = kBytes / (kPixel * width);
  return rows < 1 ? 1 : rows > height ? height : rows;
}

}  // namespace domefall
