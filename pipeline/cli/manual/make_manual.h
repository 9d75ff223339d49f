// This file writes the manual pages and the bash completion of domefall.

#pragma once

#include <filesystem>
#include <string>

namespace domefall {

// Writes man1/*.1, which bear this date, and completions/domefall into a folder.  The folder is
// made if it is not there.  If a file cannot be written, this throws std::runtime_error, whose text
// begins with the file's path.
void make_manual(const std::string& date, const std::filesystem::path& folder);

}  // namespace domefall
