// Wide blobs in a crowd, drawn as one: what bounds the cost of a sky that shrinks to a spot.
#pragma once

#include <vector>

#include "pipeline/render/blobs/cap_blob.h"

namespace domefall {

// Blobs of the same width within a square of a quarter of their sigma, if they are 16 or more, become
// one at their middle with their light together.  So a spot of the sky costs at most 16 blobs for each
// such square, however many stars crowd there.  Measured against drawing each: 1 % of the peak.
// A crowd that has no place as one blob stays.  Keeps the order; the same for any number of threads.
void merge_crowds(const Projection& projection, std::vector<CapBlob>& blobs);

}  // namespace domefall
