#include "pipeline/render/overlay/ink.h"

#include <algorithm>

namespace domefall {

template <class T>
void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               ImageRgb<T>& frame) {
  const float light[3] = {ink.light.r, ink.light.g, ink.light.b};
  coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
    const ColumnRange inside = inside_columns(projection, row);
    const int begin = std::max(first, inside.first),
              end = std::min(first + static_cast<int>(parts.size()), inside.last + 1);
    T* pixels = frame.row(row);
    for (int x = begin; x < end; ++x) {
      const auto part =
          static_cast<float>(parts[static_cast<std::size_t>(x - first)] * ink.opacity);
      if (part == 0) continue;
      for (int c = 0; c < 3; ++c) {
        T& value = pixels[3 * x + c];
        value = static_cast<float>(value) * (1 - part) + light[c] * part;
      }
    }
  });
}

template void draw_over(const Coverage&, const Ink&, const Projection&, HalfFrame&);
template void draw_over(const Coverage&, const Ink&, const Projection&, FloatImage&);

}  // namespace domefall
