// The noise that the turbulence of a disc's gas is made of.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/base/lattice_key.h"

namespace domefall {

// A NoiseTile is a picture of gas that nothing has drawn out yet, log-normal as simulations have it, with
// structure of all sizes from a sixteenth of a turn down.  It repeats in ln r and around the ring.  Each
// row has a mean of 1.  The levels i, j have the means over 2^i rows and 2^j columns, side by side and one
// below the other.
class NoiseTile {
 public:
  static constexpr int kLogRows = 10, kLogColumns = 12, kTileRows = 1 << kLogRows,
                       kTileColumns = 1 << kLogColumns;
  static constexpr double kTexelsPerLog = 1600;  // rows for each unit of ln r
  static constexpr float kOne = 512;             // of a texel

  NoiseTile();

  // A texel is two numbers of 16 bits, a row's and, above it, that of the row below.
  const std::uint32_t* texels() const { return texels_.data(); }
  // Returns the number of the first texel of a row of a level, and that of a column within a row.  One
  // more column, the first one again, comes after the last.
  [[gnu::always_inline]] static int row_at(int level, int row) {
    return (2 * kTileRows - (2 * kTileRows >> level) + row) * kStride;
  }
  [[gnu::always_inline]] static int column_at(int level, int column) {
    return 2 * kTileColumns - (2 * kTileColumns >> level) + level + column;
  }

 private:
  static constexpr int kOctaves = 8, kStride = 2 * kTileColumns + kLogColumns;
  static constexpr double kFiner = 0.72;    // of an octave's amplitude against that before
  static constexpr double kContrast = 2.4;  // the standard deviation of the logarithm
  static constexpr double kBrightest = 60;
  struct Grid {
    int rows, columns;
    std::vector<double> values{};
  };

  static Grid refined(const Grid& coarse);
  static Grid halved(const Grid& fine, int rows, int columns);
  static void make_light(Grid& noise);
  void keep_row(const Grid& level, int i, int j, int row);

  std::vector<std::uint32_t> texels_ =
      std::vector<std::uint32_t>(std::size_t{2} * kTileRows * kStride);
};

// The one tile, which is made when it is first asked for.
const NoiseTile& noise_tile();

}  // namespace domefall
