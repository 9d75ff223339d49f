// What domefall sky says of a map's orientation.
#pragma once

#include <string>

#include "pipeline/sky/make/sky_check.h"

namespace domefall {

// One line: agrees; another fits clearly better, and which; or there is nothing to tell by.
std::string verdict_sentence(const SkyCheck& check);

// Known places with what the map has there, then the orientations that fit best; to stdout.
void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places);

}  // namespace domefall
