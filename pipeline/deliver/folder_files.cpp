#include "pipeline/deliver/folder_files.h"

#include <algorithm>
#include <system_error>

#include "pipeline/image/errors.h"

namespace domefall {

namespace fs = std::filesystem;

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code error;
  if (!fs::exists(folder, error) && !error) return found;
  fs::recursive_directory_iterator entry(folder, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    const bool hidden = entry->path().filename().string().starts_with('.');
    std::error_code unknown;
    const bool is_folder = entry->symlink_status(unknown).type() == fs::file_type::directory;
    if (hidden && is_folder) entry.disable_recursion_pending();
    if (!hidden && !is_folder) found.push_back(entry->path().lexically_relative(folder).string());
  }
  if (error) throw TemporaryError(folder.string() + ": " + error.message());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace domefall
