// This file says what a .stars catalogue holds, for people and for programs.
#pragma once

#include <string>

#include "pipeline/sky/catalogue/star_file.h"

namespace domefall {

// These tell source, licence, epoch and the counts down to each magnitude, as text and as JSON.
// Both read and check the whole file, and throw InputError where it is damaged.
std::string star_page(const StarFile& file);
std::string star_json(const StarFile& file);

}  // namespace domefall
