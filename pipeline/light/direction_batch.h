// A DirectionBatch holds unit vectors along R, Theta and Phi, column by column.
#pragma once

#include <array>

namespace domefall {

struct DirectionBatch {
  static constexpr int kSize = 128;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<double> x, y, z;
};

}  // namespace domefall
