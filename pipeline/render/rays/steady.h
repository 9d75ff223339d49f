// Numbers as the keys of frames hold them, without the bits in which processors differ.
#pragma once

#include "pipeline/image/digest.h"
#include "trajectories/directions.h"

namespace domefall {

// The value rounded to 41 bits, a relative 2e-13.  The last bits of sines and powers differ between
// processors, and a frame that another node made must be recognized on this one.
double steady(double value);

// Adds a rotation, whose elements are rounded to 1e-12, since one that is 0 on one processor may be
// 1e-17 on another.
void add_rotation(Digest& digest, const M33d& m);

}  // namespace domefall
