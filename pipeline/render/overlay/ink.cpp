#include "pipeline/render/overlay/ink.h"

#include <algorithm>

namespace domefall {
namespace {

// Draws over the columns from `first` on within a range.  `parts` says how much of each is covered.
template <class T>
void draw_row(T* pixels, int first, std::span<const double> parts, const ColumnRange& range,
              const Ink& ink) {
  const float light[3] = {ink.light.r, ink.light.g, ink.light.b};
  const int begin = std::max(first, range.first),
            end = std::min(first + static_cast<int>(parts.size()), range.last + 1);
  for (int x = begin; x < end; ++x) {
    const auto part = static_cast<float>(parts[static_cast<std::size_t>(x - first)] * ink.opacity);
    if (part == 0) continue;
    for (int c = 0; c < 3; ++c) {
      T& value = pixels[3 * x + c];
      value = static_cast<float>(value) * (1 - part) + light[c] * part;
    }
  }
}

// Draws over those columns of each row that inside(row) returns.
template <class Inside>
void draw_within(const Coverage& coverage, const Ink& ink, const Inside& inside,
                 const FrameRef& frame) {
  const auto draw = [&](auto* pixels) {
    coverage.for_each_row([&](int row, int first, std::span<const double> parts) {
      draw_row(pixels->row(row), first, parts, inside(row), ink);
    });
  };
  std::visit(draw, frame.pixels);
}

}  // namespace

void draw_over(const Coverage& coverage, const Ink& ink, const Projection& projection,
               const FrameRef& frame) {
  draw_within(
      coverage, ink, [&](int row) { return inside_columns(projection, row); }, frame);
}

void draw_anywhere(const Coverage& coverage, const Ink& ink, const FrameRef& frame) {
  draw_within(
      coverage, ink,
      [&](int) {
        return ColumnRange{0, frame.width - 1};
      },
      frame);
}

}  // namespace domefall
