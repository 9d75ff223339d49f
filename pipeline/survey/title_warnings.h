// Title warnings tell of titles that would not look as their author wants them.
#pragma once

#include <vector>

#include "pipeline/show/show.h"
#include "pipeline/survey/show_warning.h"

namespace domefall {

// Returns a warning for each title
// - that no frame shows, because it begins and ends between two,
// - that has only invisible characters,
// - whose font the machine does not have,
// - with letters that no font of this machine has,
// - whose middle is not in the picture when it appears,
// - whose capitals are lower than 2 pixels there, or
// - which is so long that it runs into itself.
//
// Throws as title_letters does.
std::vector<ShowWarning> title_warnings(const Show& show);

}  // namespace domefall
