// Which pixels a cap may cover in a projection that has no formulas for caps.
#pragma once

#include <array>

#include "pipeline/render/blobs/cap_blob.h"

namespace domefall {

// The angle from the middle of a cap, whose cut is set, at which it ends.
double angular_reach(const CapBlob& blob);

// Sets what the cap may cover, all of which lies within `reach` pixels of its middle, at n.  Returns
// false if that is nothing.
bool bound_cap(const Projection& projection, const CameraDirection& n, CapBlob& blob);

// The columns that it may cover on a row, within those of the picture: several on a ring about the
// middle of a fisheye, and on both sides of a seam.
struct CapSpans {
  std::array<ColumnRange, 3> span;
  std::size_t count = 0;
};
CapSpans spans_of(const CapBlob& blob, const Projection& projection, double reach, int row,
                  const ColumnRange& inside);

}  // namespace domefall
