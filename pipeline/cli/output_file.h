// The file that a verb writes.
#pragma once

#include <filesystem>

namespace domefall {

// Throws InputError if `out` is, under this or another name, the file that is to be read.
void refuse_overwriting(const std::filesystem::path& out, const std::filesystem::path& input);

}  // namespace domefall
