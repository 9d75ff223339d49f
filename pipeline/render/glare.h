// Adds what the eye or a lens scatters of a frame's light.
#pragma once

#include "pipeline/image/layer.h"
#include "pipeline/show/show.h"
#include "projections/projection.h"

namespace domefall {

// Spreads a part of all light of a frame by the show's glare.  All that the frame shows scatters, and
// what would come from beyond its edges does not.  The law is one of angles on the sky, the same at
// all sizes and in all projections, without a seam; a Gaussian that is narrower than 0.85 pixels is as
// wide as that.  The light of the layers loses the part that is scattered, which the layer `glare` has.
template <class T>
void add_glare(const Glare& glare, const Projection& projection, LayeredFrame<T>& frame);

}  // namespace domefall
