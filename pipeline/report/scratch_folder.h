// A folder for files that are needed only for a moment.
#pragma once

#include <filesystem>

namespace domefall {

// Makes a new folder among the system's temporary ones, and removes it with all that it holds.
class ScratchFolder {
 public:
  // Throws TemporaryError if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace domefall
