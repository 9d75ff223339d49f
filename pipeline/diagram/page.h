// Draws a show on one page: where its observer goes, and when.
#pragma once

#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// An SVG document with r against show time, the orbit from above, and the path in the
// Carter-Penrose diagram.  In flat space, where the place does not change, it has the speed alone.
// It is a pure function of the show, and takes a second or less.
std::string show_page(const Show& show);

}  // namespace domefall
