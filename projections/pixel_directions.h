// Finds the directions through many pixels by SIMD code.
#pragma once

#include "projections/projection.h"

namespace domefall {

// Sets the camera's direction n and the angle that a pixel covers (radians) for `count` positions
// (i, j).  These are counted as in PixelPosition and may lie between pixels.  Measured against
// direction_at and pixel_angle, the error is below 1e-15, and below 1e-14 in a Domemaster's corners
// up to theta = 0.75 pi.
void find_directions(const Projection& projection, const double* i, const double* j, int count,
                     CameraDirection* n, double* angle);

// Sets the solid angles that pixels cover at these positions, whose directions are n, in a unit of
// the projection.
void find_areas(const Projection& projection, const CameraDirection* n, const double* i,
                const double* j, int count, float* area);

}  // namespace domefall
