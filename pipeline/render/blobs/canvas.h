// A Canvas is the part of a frame on which one thread draws blobs at a time.
#pragma once

#include <cstddef>

#include "projections/projection.h"

namespace domefall {

// A band has this many rows.  One task shades a band, draws the stars on it and stores it, all
// while the band is in the cache.
inline constexpr int kBandRows = 8;

// A canvas has consecutive rows of a frame, at most kBandRows, and knows which columns of each row
// the image covers.
struct Canvas {
  float* rgb;  // rows of 3 * width floats
  int width;
  int first_row, rows;
  const ColumnRange* columns;  // one range for each row

  float* at(int row, int column) const {
    return rgb + 3 * (static_cast<std::ptrdiff_t>(row - first_row) * width + column);
  }
};

}  // namespace domefall
