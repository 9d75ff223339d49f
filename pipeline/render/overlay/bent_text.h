// These functions add the outlines of a text to the coverage of an image.
#pragma once

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/text_surface.h"

namespace domefall {

// Adds a text on a surface as the projection shows it.  The text is moved by `shift` on the
// surface.  Curves are followed to 1/20 pixel.  An outline is left out if it comes near to the one
// direction without an image.
void add_text(const LetteredText& text, const TextSurface& surface, const TextPoint& shift,
              const Projection& projection, Coverage& coverage);

// Adds a text that lies flat in the image, centred on `middle`.  Capitals are `capital` pixels
// high.
void add_flat_text(const LetteredText& text, const ImagePoint& middle, double capital,
                   Coverage& coverage);

}  // namespace domefall
