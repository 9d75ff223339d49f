// This file draws on one page where a show's observer goes, and when.
#pragma once

#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// Returns an SVG document with r against show time, the orbit from above, and the path in the
// Carter-Penrose diagram.  In flat space, where the place does not change, it has the speed alone.
// It depends on the show alone, and takes a second or less.
std::string show_page(const Show& show);

}  // namespace domefall
