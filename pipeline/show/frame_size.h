// The size of pictures as users give it.
#pragma once

#include <string>

#include "projections/projection.h"

namespace domefall {

// A projection with the size that a text gives: 1k, 2k, 4k, 8k or pixels for the width of a dome
// or of a whole sphere and for the faces of a cubemap, and WIDTHxHEIGHT for a flat image or a part
// of a fisheye.  An empty text leaves it as it is.  Throws InputError for any other text,
// whose message calls it by `name`.
Projection resized(const Projection& projection, const std::string& size,
                   const std::string& name = "--size");

}  // namespace domefall
