// A FileWatch tells when a file has been written anew.
#pragma once

#include <filesystem>
#include <set>

#include "pipeline/image/descriptor.h"

namespace domefall {

// The folder that holds the file is watched, since most editors write another file and rename it.
// So is the folder of the file that a link leads to.
class FileWatch {
 public:
  // Throws TemporaryError if the system grants no watch.
  explicit FileWatch(const std::filesystem::path& file);

  // Waits until the file was written or replaced, or `milliseconds` have passed.  Returns true for
  // the former.  Throws TemporaryError if the folder is no longer there, after which nothing is
  // seen.
  bool wait(int milliseconds);

 private:
  Descriptor inotify_;
  std::filesystem::path file_;
  std::set<std::filesystem::path> names_;
};

}  // namespace domefall
