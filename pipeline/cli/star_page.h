// What a .stars catalogue holds, for readers and for programs.
#pragma once

#include <string>

#include "pipeline/sky/catalogue/star_file.h"

namespace domefall {

// Source, licence, epoch, counts down to each magnitude.  Reads and checks the whole file: throws InputError
// where it is damaged.
std::string star_page(const StarFile& file);
std::string star_json(const StarFile& file);

}  // namespace domefall
