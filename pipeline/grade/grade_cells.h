// This file says how a GradeTable divides the colours into cells, for the sources that make it and
// look into it.
#pragma once

#include <Imath/half.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

}  // namespace domefall::grade_cells
