// The key of a frame includes a digest of the outlines of the texts in the frame.
#pragma once

#include "pipeline/image/digest.h"
#include "pipeline/lettering/lettering.h"

namespace domefall {

// Adds the outlines of a text, rounded to 1e-5 of a capital's height.  They depend on the machine's
// fonts.
void add_outlines(Digest& digest, const LetteredText& text);

}  // namespace domefall
