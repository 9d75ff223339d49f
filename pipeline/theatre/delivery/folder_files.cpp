#include "pipeline/theatre/delivery/folder_files.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "pipeline/base/errors.h"
#include "pipeline/base/utf8.h"

namespace domefall {

namespace fs = std::filesystem;

bool is_left_behind(std::string_view name) {
  const std::string small = in_lower_case(name);
  return name.starts_with('.') ||
         std::ranges::find(kLeftBehind, std::string_view(small)) != std::end(kLeftBehind) ||
         std::ranges::any_of(kLeftBehindEnds,
                             [&](std::string_view end) { return small.ends_with(end); });
}

FolderFiles files_below(const fs::path& folder) {
  FolderFiles found;
  std::error_code error;
  if (!fs::exists(folder, error) && !error) return found;
  fs::recursive_directory_iterator entry(folder, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    const bool is_others = is_left_behind(entry->path().filename().string());
    std::error_code unknown;
    const bool is_folder = entry->symlink_status(unknown).type() == fs::file_type::directory;
    if (is_others && is_folder) entry.disable_recursion_pending();
    const std::string path = entry->path().lexically_relative(folder).string();
    if (is_others)
      found.left_behind.push_back(path + (is_folder ? "/" : ""));
    else if (!is_folder)
      found.files.push_back(path);
  }
  if (error) throw TemporaryError(folder.string() + ": " + error.message());
  std::ranges::sort(found.files);
  std::ranges::sort(found.left_behind);
  return found;
}

}  // namespace domefall
