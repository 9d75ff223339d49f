// These functions find the pixels that a cap may cover in a projection that has no formulas for
// caps.
#pragma once

#include <array>

#include "pipeline/render/blobs/cap_blob.h"

namespace domefall {

// Returns the angle (radians) from its middle at which a cap ends.  Its cut must be set.
double angular_reach(const CapBlob& blob);

// Sets the rows and columns that the cap with its middle at n may cover, and the distance `reach`
// in pixels from its middle within which all of it lies.  Returns false if it covers nothing.
bool bound_cap(const Projection& projection, const CameraDirection& n, CapBlob& blob);

// CapSpans are the columns, within those of the image, that a cap may cover on one row.  There
// are several spans where the cap lies on a ring about the middle of a fisheye, or on both sides of
// a seam.
struct CapSpans {
  std::array<ColumnRange, 3> span;
  std::size_t count = 0;
};
CapSpans spans_of(const CapBlob& blob, const Projection& projection, double reach, int row,
                  const ColumnRange& inside);

}  // namespace domefall
