// How a GradeTable divides the colours into cells, and the interpolation in its nodes.
#pragma once

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "pipeline/grade/pixel_planes.h"

namespace domefall::grade_cells {

inline constexpr int kGreys = 21, kHues = 9, kOrders = 6, kNodeStep = 32, kInfinityBits = 0x7c00;
inline constexpr int kLargest = kInfinityBits / kNodeStep + 1;  // nodes of the largest channel
// These are the nodes with a neighbour on either side, which are the middles of cells.
inline constexpr int kInnerGreys = kGreys - 2, kInnerHues = kHues - 2;
inline constexpr int kCells = kLargest - 1;                    // of the largest channel
inline constexpr float kLeastGrey = 0.25f, kLeastRoot = 0.5f;  // and its square root
inline constexpr float kRootScale = (kGreys - 1) / (1 - kLeastRoot), kHueScale = kHues - 1;
inline constexpr float kBrightest = 65504;  // the largest half

// A node has the three codes, of which 65535 is white.  A fourth number says whether the table
// holds the cell in whose middle the node stands, and which reaches up to the next node of the
// largest channel.  Nodes that differ in the largest channel alone follow each other.
inline constexpr int kNode = 4, kHeld = 3;
inline constexpr int kColumn = kNode * kLargest, kRow = kColumn * kHues, kOrder = kRow * kGreys;
inline constexpr std::size_t kTable = static_cast<std::size_t>(kOrder) * kOrders;

inline constexpr std::size_t node_at(int order, int n, int grey, int hue) {
  return static_cast<std::size_t>(order * kOrder + grey * kRow + hue * kColumn + n * kNode);
}

// These are the channels from the largest to the least, for each order.  An order's number, counted
// from 0, is (r >= g) + 2 (g >= b) + 4 (b >= r) - 1.
inline constexpr int kChannels[kOrders][3] = {{0, 2, 1}, {1, 0, 2}, {0, 1, 2},
                                              {2, 1, 0}, {2, 0, 1}, {1, 2, 0}};

inline float value_of(int bits) {
  Imath::half h;
  h.setBits(static_cast<std::uint16_t>(std::min(bits, kInfinityBits - 1)));
  return h;
}

// Sets a pixel by its largest channel and by its place between nodes.
inline void put_pixel(int order, float largest, float grey, float hue, float* rgb) {
  const float root = kLeastRoot + grey / kRootScale, least = root * root * largest;
  rgb[kChannels[order][0]] = largest;
  rgb[kChannels[order][1]] = least + hue / kHueScale * (largest - least);
  rgb[kChannels[order][2]] = least;
}

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
