// These are the files of a delivery as they lie on the disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

// Returns the paths below the folder, with '/' and sorted, of all files in it and in those below
// it.  Hidden files and folders are left out, but links and special files are not.  A folder that
// is missing has no files.  Throws TemporaryError where a folder cannot be read.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace domefall
