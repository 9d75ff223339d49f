// These are the files of a delivery as they lie on the disk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

// Returns the paths below the folder, with '/' and sorted, of all files in it and in those below
// it.  Hidden files and folders are left out, links and special files are not.  A folder that is
// missing has none.  Throws TemporaryError where one cannot be read.
std::vector<std::string> files_below(const std::filesystem::path& folder);

}  // namespace domefall
