#include "pipeline/sources/disc/noise_tile.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/base/simd/vector_math.h"

namespace domefall {
namespace {

// From -1 to 1.
double even(std::uint32_t key) {
  return static_cast<double>(static_cast<int>(key >> 8)) * 0x1p-23 - 1;
}

}  // namespace

NoiseTile::NoiseTile() {
  Grid grid{.rows = kTileRows >> kOctaves, .columns = kTileColumns >> kOctaves};
  grid.values.resize(static_cast<std::size_t>(grid.rows * grid.columns));
  double part = 1;
  for (std::uint32_t octave = 0; octave <= kOctaves; ++octave, part *= kFiner) {
    if (octave > 0) grid = refined(grid);
    for (std::size_t k = 0; k < grid.values.size(); ++k)
      grid.values[k] += part * even(lattice_key(octave, static_cast<std::uint32_t>(k)));
  }
  make_light(grid);
  for (int i = 0; i <= kLogRows; ++i) {
    Grid level = grid;
    for (int j = 0; j <= kLogColumns; ++j) {
      for (int row = 0; row < level.rows; ++row) keep_row(level, i, j, row);
      level = halved(level, 1, 2);
    }
    grid = halved(grid, 2, 1);
  }
}

// Returns a grid with twice as many rows and columns, by the subdivision of quadratic B-splines.
NoiseTile::Grid NoiseTile::refined(const Grid& coarse) {
  Grid fine{2 * coarse.rows, 2 * coarse.columns};
  fine.values.reserve(4 * coarse.values.size());
  const auto old = [&](int row, int column) {
    return coarse.values[static_cast<std::size_t>((row & (coarse.rows - 1)) * coarse.columns +
                                                  (column & (coarse.columns - 1)))];
  };
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.columns; ++column) {
      const int y = row / 2, x = column / 2, down = row % 2 ? 1 : -1, right = column % 2 ? 1 : -1;
      fine.values.push_back(0.5625 * old(y, x) + 0.1875 * (old(y + down, x) + old(y, x + right)) +
                            0.0625 * old(y + down, x + right));
    }
  return fine;
}

// Returns the means of so many rows and columns.
NoiseTile::Grid NoiseTile::halved(const Grid& fine, int rows, int columns) {
  Grid coarse{fine.rows / rows, fine.columns / columns};
  coarse.values.reserve(fine.values.size() / 2);
  for (int row = 0; row < coarse.rows; ++row)
    for (int column = 0; column < coarse.columns; ++column) {
      const auto at = static_cast<std::size_t>(row * rows * fine.columns + column * columns);
      const auto next = at + static_cast<std::size_t>(rows > 1 ? fine.columns : 1);
      coarse.values.push_back((fine.values[at] + fine.values[next]) / 2);
    }
  return coarse;
}

// Makes the noise log-normal, with a mean of 1 in each row.
void NoiseTile::make_light(Grid& noise) {
  double sum = 0, squares = 0;
  for (const double v : noise.values) sum += v, squares += v * v;
  const auto count = static_cast<double>(noise.values.size());
  const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
  for (double& v : noise.values) v = exponential(kContrast * (v - mean) / deviation);
  // What is brighter than this is taken for as bright, and its row made brighter for it.
  for (const double brightest : {kBrightest, kBrightest, 1e9})
    for (auto row = noise.values.begin(); row != noise.values.end(); row += kTileColumns) {
      const double scale = kTileColumns / std::accumulate(row, row + kTileColumns, 0.0);
      std::transform(row, row + kTileColumns, row,
                     [&](double v) { return std::min(scale * v, brightest); });
    }
}

// Rounds a row of a level so that its mean stays what it is.
void NoiseTile::keep_row(const Grid& level, int i, int j, int row) {
  const int above = (row + level.rows - 1) % level.rows;
  const auto keep = [&](int column, std::uint32_t value) {
    texels_[static_cast<std::size_t>(row_at(i, row) + column_at(j, column))] |= value;
    texels_[static_cast<std::size_t>(row_at(i, above) + column_at(j, column))] |= value << 16;
  };
  const double* const values = &level.values[static_cast<std::size_t>(row * level.columns)];
  double sum = 0;
  std::uint32_t before = 0, first = 0;
  for (int k = 0; k < level.columns; ++k) {
    sum += kOne * values[k];
    const auto until = static_cast<std::uint32_t>(std::lround(sum));
    if (k == 0) first = until;
    keep(k, until - before);
    before = until;
  }
  keep(level.columns, first);
}

const NoiseTile& noise_tile() {
  static const NoiseTile tile;
  return tile;
}

}  // namespace domefall
