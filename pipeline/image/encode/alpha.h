// An alpha that says where a projection shows anything.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pipeline/image/encode/row_source.h"

namespace domefall {

// Returns samples rgb[rows][width][3], of rows from `first` on, as [rows][width][4].  The alpha of
// opaque columns is the greatest sample there is, and 0 elsewhere.
template <class Sample>
std::vector<Sample> with_alpha(const Sample* rgb, int width, int first, int rows,
                               const OpaqueColumns& opaque) {
  std::vector<Sample> rgba(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
  Sample* out = rgba.data();
  for (int row = first; row < first + rows; ++row) {
    const auto columns = opaque(row);
    for (int x = 0; x < width; ++x, rgb += 3) {
      out = std::copy(rgb, rgb + 3, out);
      *out++ =
          x >= columns.first && x < columns.second ? static_cast<Sample>(~Sample{0}) : Sample{0};
    }
  }
  return rgba;
}

}  // namespace domefall
