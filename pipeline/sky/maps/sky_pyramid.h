// Sky maps in the making: the levels' memory, the rounding to halves, the coarser levels, the borders.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// The unit in which `greatest` (> 0; of any channel of any texel) is 2^13 to 2^14.  1 if it is 0.
double sky_unit(double greatest);

// The sizes of a map's levels, from `size`, a power of two, to 1.
std::vector<int> level_sizes(int size);

struct SkyPyramid {
  struct Level {
    int size;
    SkyTexel* texels;
    SkyTexel* face(int k) const {
      return texels + static_cast<std::size_t>(k) * SkyLevel::face_texels(size);
    }
    SkyTexel& at(int face_number, int i, int j) const;  // -1 <= i, j <= size
  };

  SkyMapKind kind;
  double unit;
  std::vector<Level> levels;
  std::shared_ptr<void> owner;

  // In memory of its own, zeroed.  `size` is a power of two, at most kLargestFace.
  SkyPyramid(SkyMapKind of_kind, double in_unit, int size);
  // In memory that `of_owner` keeps alive.
  SkyPyramid(SkyMapKind of_kind, double in_unit, std::vector<Level> in,
             std::shared_ptr<void> of_owner);

  // The coarser levels from the finest, whose border is set already; then `this` is a map.
  void finish() const;
  SkyMap map() const;
};

inline constexpr int kLargestFace = 8192;

// Each border texel looks across the edge, at the face that owns its direction, and is what a look
// there sees between that face's inner texels.
void fill_border(const SkyPyramid::Level& level);

// Channels (in units of the map) at a place of the sphere, which need not have unit length.  Called
// from several threads.
using SkyPainter = std::function<void(const V3d& direction, float channel[4])>;
// Sets the finest level, border and all; each texel is the mean of looks x looks places.
void paint(const SkyPyramid::Level& level, const SkyPainter& painter, int looks = 1);

}  // namespace domefall
