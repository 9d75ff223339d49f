// The markers of a show as the chapters of a movie, in the text that ffmpeg reads (ffmetadata).
#pragma once

#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// Returns the chapters of the frames [first, first + count), each from its marker to the next one.
// Before the first marker lies a chapter with the show's title.  The text is empty for a show
// without markers.
std::string chapters(const Show& show, int first, int count);

}  // namespace domefall
