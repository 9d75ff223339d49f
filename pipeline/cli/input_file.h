// The files that a verb reads because the command line names them.
#pragma once

#include <filesystem>

namespace domefall {

// Throws InputError where nothing has this name, since then it is misspelt.  What else may be wrong
// with a file is told when it is read.
void require_file(const std::filesystem::path& input);

}  // namespace domefall
