// Each face of a cubemap is an image of its own without a seam.
#pragma once

#include <array>
#include <vector>

#include "projections/projection.h"

namespace domefall {

// A CubemapFace has its top left pixel on the cube's net, counted from 0, its own projection, and
// the axes X, Y, Z of its camera in that of the whole net.
struct CubemapFace {
  int column, row;
  Projection projection;
  std::array<Imath::V3d, 3> axes;
};

// Returns the faces in the order of kFaceAxes (sphere_formulas.h).  Returns none for the other
// projections.  They have no seam, or continue beyond it as one function of the pixel, as the
// equirectangular one does.
std::vector<CubemapFace> cubemap_faces(const Projection& p);

}  // namespace domefall
