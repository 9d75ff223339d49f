// Users give the size of frames as a text, which this function applies to a projection.
#pragma once

#include <string>

#include "projections/projection.h"

namespace domefall {

// Returns a projection with the size that a text gives.  The text is 1k, 2k, 4k, 8k or a number of
// pixels for the width of a dome or of a whole sphere and for the faces of a cubemap, and
// WIDTHxHEIGHT for a flat image or a part of a fisheye.  An empty text leaves the projection as it
// is.  Throws InputError for any other text, and its message calls the text by `name`.
Projection resized(const Projection& projection, const std::string& size,
                   const std::string& name = "--size");

}  // namespace domefall
