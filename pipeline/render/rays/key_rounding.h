// Rounds numbers for the keys of frames, so that the bits in which processors differ drop out.
#pragma once

#include "pipeline/base/digest.h"
#include "trajectories/directions.h"

namespace domefall {

// Returns the value rounded to 41 bits, a relative 2e-13.  The last bits of sines and powers differ
// between processors, but a frame that another node made must be recognised on this one.
double rounded_for_key(double value);

// Adds a rotation with its elements rounded to multiples of 1e-12.  A relative rounding would not
// do, since an element that is 0 on one processor may be 1e-17 on another.
void add_rotation(Digest& digest, const M33d& m);

}  // namespace domefall
