#include "pipeline/sources/disc/pattern_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "pipeline/image/read_image.h"
#include "pipeline/sources/colour/colour_space.h"

namespace domefall {
namespace {

constexpr int kMostColumns = 8192, kMostRows = 2048;

// Returns `from` values as `to` of them, each the mean over its part of the whole.
std::vector<float> resampled(const std::vector<float>& values, int to) {
  const double step = static_cast<double>(values.size()) / to;
  std::vector<float> result(static_cast<std::size_t>(to));
  for (int k = 0; k < to; ++k) {
    const double begin = k * step, end = (k + 1) * step;
    double sum = 0;
    for (auto at = static_cast<std::size_t>(begin); at < values.size(); ++at) {
      const double covered =
          std::min(end, static_cast<double>(at + 1)) - std::max(begin, static_cast<double>(at));
      if (covered <= 0) break;
      sum += covered * values[at];
    }
    result[static_cast<std::size_t>(k)] = static_cast<float>(sum / step);
  }
  return result;
}

int halvings(int size) { return std::bit_width(static_cast<unsigned>(size)) - 1; }
int kept_size(int size, int most) {
  return std::min(most, static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))));
}

}  // namespace

PatternMap::PatternMap(const MapPattern& pattern) : inner_(pattern.inner), outer_(pattern.outer) {
  const PictureLight picture = read_image(pattern.file);
  const int width = picture.pixels.width, height = picture.pixels.height;
  Level finest{kept_size(width, kMostColumns), kept_size(height, kMostRows), {}};
  std::vector<std::vector<float>> columns(static_cast<std::size_t>(finest.columns));
  // Rows of the picture become narrower or wider, and then columns become lower or higher.
  const ColourMatrix to_working = working_from_rgb(picture.xy);
  for (int row = height - 1; row >= 0; --row) {
    std::vector<float> light(static_cast<std::size_t>(width));
    for (int k = 0; k < width; ++k) {
      const float* rgb = picture.pixels.row(row) + 3 * static_cast<std::ptrdiff_t>(k);
      std::array<float, 3> working;
      for (int c = 0; c < 3; ++c)
        working[static_cast<std::size_t>(c)] = static_cast<float>(
            to_working[c][0] * rgb[0] + to_working[c][1] * rgb[1] + to_working[c][2] * rgb[2]);
      light[static_cast<std::size_t>(k)] = static_cast<float>(
          std::max(0.0, luminance(WorkingRgb{working[0], working[1], working[2]})));
    }
    light = resampled(light, finest.columns);
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(light[k]);
  }
  for (std::vector<float>& column : columns) column = resampled(column, finest.rows);
  for (int row = 0; row < finest.rows; ++row)
    for (const std::vector<float>& column : columns)
      finest.values.push_back(column[static_cast<std::size_t>(row)]);
  column_levels_ = halvings(finest.columns) + 1, row_levels_ = halvings(finest.rows) + 1;
  levels_.push_back(std::move(finest));
  for (int j = 0; j < row_levels_; ++j)
    for (int i = j == 0 ? 1 : 0; i < column_levels_; ++i) {
      const bool narrower = i > 0;
      const Level& from = narrower ? level(i - 1, j) : level(0, j - 1);
      Level to{
          narrower ? from.columns / 2 : from.columns, narrower ? from.rows : from.rows / 2, {}};
      to.values.reserve(static_cast<std::size_t>(to.columns) * static_cast<std::size_t>(to.rows));
      const std::ptrdiff_t next = narrower ? 1 : from.columns;
      for (int row = 0; row < to.rows; ++row)
        for (int k = 0; k < to.columns; ++k) {
          const float* at = from.values.data() +
                            std::ptrdiff_t{narrower ? row : 2 * row} * from.columns +
                            (narrower ? 2 * k : k);
          to.values.push_back((at[0] + at[next]) / 2);
        }
      levels_.push_back(std::move(to));
    }
}

// Interpolates at x and y from 0 to 1; x goes around.
double PatternMap::value(const Level& l, double x, double y) const {
  const double column = x * l.columns - 0.5, row = std::clamp(y * l.rows - 0.5, 0.0, l.rows - 1.0);
  const double left = std::floor(column);
  const int i = static_cast<int>(left) & (l.columns - 1), next = (i + 1) & (l.columns - 1),
            j = static_cast<int>(row), below = std::min(j + 1, l.rows - 1);
  const auto at = [&](int r, int c) {
    return static_cast<double>(l.values[static_cast<std::size_t>(r * l.columns + c)]);
  };
  const double on = column - left, down = row - j;
  return (1 - down) * ((1 - on) * at(j, i) + on * at(j, next)) +
         down * ((1 - on) * at(below, i) + on * at(below, next));
}

double PatternMap::mean(double r, double azimuth, double high, double wide) const {
  const double turns = azimuth / (2 * std::numbers::pi), x = turns - std::floor(turns),
               y = (r - inner_) / (outer_ - inner_);
  const auto level_of = [](double texels, int levels) {
    return std::clamp(std::log2(std::max(texels, 1.0)), 0.0, levels - 1.0);
  };
  const double across =
                   level_of(wide / (2 * std::numbers::pi) * levels_[0].columns, column_levels_),
               along = level_of(high / (outer_ - inner_) * levels_[0].rows, row_levels_);
  const int i = std::min(static_cast<int>(across), column_levels_ - 1),
            j = std::min(static_cast<int>(along), row_levels_ - 1);
  const double more_i = across - i, more_j = along - j;
  const auto mixed = [&](int rows) {
    const double fine = value(level(i, rows), x, y);
    if (more_i == 0) return fine;
    return fine + more_i * (value(level(i + 1, rows), x, y) - fine);
  };
  const double fine = mixed(j);
  return more_j == 0 ? fine : fine + more_j * (mixed(j + 1) - fine);
}

}  // namespace domefall
