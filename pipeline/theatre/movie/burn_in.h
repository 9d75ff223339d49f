// A review movie says in its corners which number each frame has, and what the show is doing.
#pragma once

#include <string>
#include <vector>

#include "pipeline/show/show.h"
#include "pipeline/theatre/movie/preset.h"

namespace domefall {

// Returns subtitles in the ASS format, in which each of the frames, in their order, has a tenth of
// a second.  The corners have the texts of burn_in_text.h.  The result is empty for a show whose
// overlays write them into the frames already.
std::string burn_in(const Show& show, const std::vector<int>& frames, const MovieSize& size);

}  // namespace domefall
