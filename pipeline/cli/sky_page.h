// This file says what a .sky file holds, for people and for other programs.
#pragma once

#include <string>

#include "pipeline/sky/maps/sky_file.h"

namespace domefall {

std::string sky_page(const SkyFile& file);

// Returns one JSON object with the facts of the page.  `verified` says that all checksums have been
// compared and are right.  Otherwise its key is null.
std::string sky_json(const SkyFile& file, bool verified);

}  // namespace domefall
