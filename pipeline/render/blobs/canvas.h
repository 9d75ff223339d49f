// The part of a frame on which one thread draws blobs at a time.
#pragma once

#include <cstddef>

#include "projections/projection.h"

namespace domefall {

// The rows of a band.  One task shades a band, draws the stars on it and stores it, all while the
// band is in the cache.
inline constexpr int kBandRows = 8;

// Consecutive rows of a frame, at most kBandRows, with the columns of each that the image covers.
struct Canvas {
  float* rgb;  // rows of 3 * width floats
  int width;
  int first_row, rows;
  const ColumnRange* columns;  // one range a row

  float* at(int row, int column) const {
    return rgb + 3 * (static_cast<std::ptrdiff_t>(row - first_row) * width + column);
  }
};

}  // namespace domefall
