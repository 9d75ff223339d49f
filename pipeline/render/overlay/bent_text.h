// The outlines of a text in a picture.
#pragma once

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/overlay/text_surface.h"

namespace domefall {

// Adds a text on a surface, moved by `shift` there, as the projection shows it.  Curves are
// followed to 1/20 pixel.  An outline that comes near to the one direction without an image is
// left out.
void add_text(const LetteredText& text, const TextSurface& surface, const TextPoint& shift,
              const Projection& projection, Coverage& coverage);

// Adds a text that lies flat in the picture about a place, with capitals of so many pixels.
void add_flat_text(const LetteredText& text, const PicturePoint& middle, double capital,
                   Coverage& coverage);

}  // namespace domefall
