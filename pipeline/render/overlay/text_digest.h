// What the key of a frame holds of a text in it.
#pragma once

#include "pipeline/image/digest.h"
#include "pipeline/lettering/lettering.h"

namespace domefall {

// Adds the outlines of a text, to 1e-5 of a capital's height, which depend on the machine's fonts.
void add_outlines(Digest& digest, const LetteredText& text);

}  // namespace domefall
