// These facts are what the page of the live preview knows of a show besides its pictures, as JSON.
#pragma once

#include <atomic>
#include <string>

#include "pipeline/preview/live_show.h"

namespace domefall {

// Returns the show's times, names and choices, and what its observer's instruments say along it.
// It takes some 0.1 s for a long show.
std::string show_facts(const LiveShow::Version& version, int threads);

// Returns a part of what `check` reports.  This is of jumps, of stars that blind behind the hole,
// of titles that nobody sees, and of where the show is brightest and darkest.  A short show takes
// 0.1 s, a long one seconds.  Returns nothing, and early, once `stop` is set.
std::string show_warnings_as_json(const Show& show, const std::atomic<bool>& stop);

// Returns an empty list of warnings.  It says whether the search for them is `done`.
std::string no_warnings_as_json(bool done);

}  // namespace domefall
