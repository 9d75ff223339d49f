#pragma once

#include <array>

namespace domefall {

// Returns the Catmull-Rom weights of four samples, at t in [0, 1) between the second and the third.
template <class T>
constexpr std::array<T, 4> catmull_rom(T t) {
  const T t2 = t * t, t3 = t2 * t;
  return {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2,
          (t3 - t2) / 2};
}

}  // namespace domefall
