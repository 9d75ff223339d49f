// This file says what `domefall sky check` and `domefall sky import` tell of a map's orientation.
#pragma once

#include <string>

#include "pipeline/sky/make/sky_check.h"

namespace domefall {

// Returns one line.  It says that the stated orientation agrees, or that another fits clearly
// better and which, or that nothing can be told.
std::string verdict_sentence(const SkyCheck& check);

// Prints to standard output the known places with what the map has there, and then the orientations
// that fit best.
void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places);

}  // namespace domefall
