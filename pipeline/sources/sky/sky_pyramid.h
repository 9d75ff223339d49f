// A sky pyramid is a sky map in the making.  It has the memory of the levels, makes the coarser
// levels, and fills the borders.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pipeline/sources/sky/sky_map.h"

namespace domefall {

// Returns the unit, a power of two, in which `greatest` is at least 2^13 and less than 2^14.
// `greatest` is the largest value of any channel of any texel.  If it is 0, the unit is 1.
double sky_unit(double greatest);

// Returns the sizes of a map's levels, from `size`, a power of two, down to 1.
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

  // Makes a dark map in memory of its own.  `size` is a power of two, at most kLargestFace.
  SkyPyramid(SkyMapKind of_kind, double in_unit, int size);
  // Makes a map in memory that `of_owner` keeps alive and that has `in` for its levels.
  SkyPyramid(SkyMapKind of_kind, double in_unit, std::vector<Level> in,
             std::shared_ptr<void> of_owner);

  // Makes the coarser levels from the finest, whose border must be set.  Then map() is complete.
  void finish() const;
  SkyMap map() const;
};

// Sets the border of every face.  A texel of the border has a direction that belongs to the face
// across the edge, and it gets the value that a sample there finds between that face's inner
// texels.
void fill_border(const SkyPyramid::Level& level);

// A painter gives the channels, in units of the map, in a direction of any length.  Several threads
// call it at the same time.
using SkyPainter = std::function<void(const V3d& direction, float channel[4])>;
// Sets a level, including its border.  Each texel is the mean of `across` x `across` samples.
void paint(const SkyPyramid::Level& level, const SkyPainter& painter, int across = 1);

}  // namespace domefall
