// A show on one page: where its observer goes and when.
#pragma once

#include <string>

#include "pipeline/show/show.h"

namespace domefall {

// An SVG document: r against show time, the orbit from above, and the path in the Carter-Penrose
// diagram; in flat space, where the place does not change, the speed alone.  A pure function of the
// show; a second or less.
std::string show_page(const Show& show);

}  // namespace domefall
