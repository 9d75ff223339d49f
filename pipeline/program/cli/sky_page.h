// This file says what a .sky file holds, for people and for other programs, and what is found of a
// map's orientation.
#pragma once

#include <string>

#include "pipeline/sources/sky/sky_check.h"
#include "pipeline/sources/sky/sky_file.h"

namespace domefall {

std::string sky_page(const SkyFile& file);

// Returns one JSON object with the facts of the page.  `verified` says that all checksums have been
// compared and are right.  Otherwise its key is null.
std::string sky_json(const SkyFile& file, bool verified);

// Says as what a picture is taken (picture_taken), as a page or as one JSON object.
std::string picture_page(const std::string& taken, bool json);

// Returns one line.  It says that the stated orientation agrees, or that another fits clearly
// better and which, or that nothing can be told.
std::string verdict_sentence(const SkyCheck& check);

// Prints to standard output the known places with what the map has there, and then the orientations
// that fit best.
void print_check(const SkyCheck& check, const std::vector<KnownPlace>& places);

}  // namespace domefall
