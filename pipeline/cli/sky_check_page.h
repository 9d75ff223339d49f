// What domefall sky says of a map's orientation.
#pragma once

#include <string>

#include "pipeline/sky/make/sky_check.h"

namespace domefall {

// One line: that the stated orientation agrees, that another fits clearly better and which, or that
// nothing can be told.
std::string verdict_sentence(const SkyCheck& check);

// Prints the known places with what the map has there, then the orientations that fit best, to
// stdout.
void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places);

}  // namespace domefall
