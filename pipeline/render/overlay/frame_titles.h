// These functions draw the titles of a show into its frames.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pipeline/base/lettering.h"
#include "pipeline/render/overlay/coverage.h"
#include "pipeline/show/frame_state.h"

namespace domefall {

struct SeenTitle {
  const Title* title;
  std::string text;  // with numbers in the place of counters
  double opacity;    // above 0, at most 1
};

// Returns the titles that are seen at a state's instant.  Those of the show come before those of
// its segments.  There are none if the show does not draw its titles.
std::vector<SeenTitle> seen_titles(const Show& show, const FrameState& state);

// Returns the outlines of a title's text, which are kept for a while.  It may be called from any
// thread.  Throws as lettered().
std::shared_ptr<const LetteredText> title_letters(const std::string& text,
                                                  const LetterStyle& style);

// Returns a digest of everything that the titles of a frame change in it.  It includes their
// outlines, which depend on the machine's fonts.  It is empty for a frame without titles.  Throws
// as title_letters.
std::string titles_key(const Show& show, const FrameState& state);

// Returns how much of each pixel's light a title covers, by its letters, lines, plate and
// shadow, and by its opacity, [height][width].
// Throws as title_letters.
std::vector<float> covered_by(const Show& show, const SeenTitle& seen, const FrameState& state);

// Draws the titles over a frame, in the order of seen_titles().  Throws as title_letters.
void draw_titles(const Show& show, const FrameState& state, const FrameRef& frame);

}  // namespace domefall
