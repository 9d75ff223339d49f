// The parts of pictures that are put together from several.
#pragma once

#include <array>
#include <vector>

#include "projections/projection.h"

namespace domefall {

// A part of a picture without a seam, a projection of its own: its top left pixel, counted from 0,
// and the axes X, Y, Z of its camera in that of the whole.
struct PicturePart {
  int column, row;
  Projection projection;
  std::array<Imath::V3d, 3> axes;
};

// The faces of a cube's net.  Nothing for other projections, which are seamless or, as a picture of
// the whole sphere, one function of the pixel beyond their seam.
std::vector<PicturePart> picture_parts(const Projection& p);

}  // namespace domefall
