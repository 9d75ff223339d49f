// What an author may not have wanted of the titles of a show.
#pragma once

#include <vector>

#include "pipeline/survey/show_jumps.h"

namespace domefall {

// A warning for each title that no frame shows, since it begins and ends between two, which has
// invisible characters alone, whose font the machine does not have, which has letters that none of
// its fonts has, whose middle is not in the picture when it appears, whose capitals are lower than
// 2 pixels there, or which is so long that it runs into itself.  Throws as title_letters.
std::vector<ShowWarning> title_warnings(const Show& show);

}  // namespace domefall
