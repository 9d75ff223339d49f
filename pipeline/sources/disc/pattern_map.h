// A PatternMap is an artist's picture of the gas of a disc, by azimuth and radius.  It turns with the
// gas, and so is wound up by the faster orbits further in.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/sources/disc/disc.h"

namespace domefall {

class PatternMap {
 public:
  // Reads the picture.  Throws as read_image.  It may have any size, and is kept as at most 8192 x
  // 2048.
  explicit PatternMap(const MapPattern& pattern);

  // Returns the mean of the picture's light around a place, over `high` M of r and `wide` radians.
  double mean(double r, double azimuth, double high, double wide) const;

 private:
  // For every pair of halvings along and across, which are few enough to be kept as a whole.
  struct Level {
    int columns, rows;
    std::vector<float> values;
  };
  double value(const Level& level, double x, double y) const;
  const Level& level(int halved_columns, int halved_rows) const {
    return levels_[static_cast<std::size_t>(halved_rows * column_levels_ + halved_columns)];
  }

  double inner_, outer_;
  int column_levels_ = 0, row_levels_ = 0;
  std::vector<Level> levels_;
};

}  // namespace domefall
