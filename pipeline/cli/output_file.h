// Where a verb writes.
#pragma once

#include <filesystem>

namespace domefall {

// Throws InputError if `out` is the file (or a name of the file) that is to be read.
void refuse_overwriting(const std::filesystem::path& out, const std::filesystem::path& input);

}  // namespace domefall
