// These functions interpolate in the nodes of a GradeTable.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/grade/grade_cells.h"
#include "pipeline/grade/pixel_planes.h"

namespace domefall::grade_cells {

// Parabolas hold the weights of three nodes in the parabola through them, for pixels.
struct Parabolas {
  alignas(64) std::array<float, PixelPlanes::kSize> before, middle, after;
};

// Places say where pixels fall in a table.
struct Places {
  static constexpr int kSize = PixelPlanes::kSize;
  // These are the middle one of the nodes around a pixel, and whether the table may be asked: 0
  // never, 1 if it holds the cell, 2 always.
  alignas(64) std::array<std::int32_t, kSize> node, asked;
  Parabolas grey, hue;
  // This is how far the pixel is from the lower to the upper node of the largest channel.
  alignas(64) std::array<float, kSize> largest;
};

// Sets the place of one pixel.  `grey` and `hue` are in steps from the middle node.
void put_place(Places& places, int k, std::size_t node, float grey, float hue, float largest);

void locate(const PixelPlanes& planes, int count, Places& places);

// Writes the codes of pixels and, to missed[], the numbers of those that the table does not hold,
// whose codes mean nothing.  Returns how many those are.  out[] and missed[] have room for one
// value more than is needed, which is overwritten.
int interpolate(const float* nodes, const Places& places, int count, unsigned short* out,
                int* missed);

}  // namespace domefall::grade_cells
