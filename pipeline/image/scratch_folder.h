// A ScratchFolder is a folder for files that are needed only for a moment.
#pragma once

#include <filesystem>
#include <string>

namespace domefall {

// It is a new folder in $TMPDIR, or /tmp, that only this user may enter.  It is removed with all
// that it holds, also where a signal ends the program.  What a program that was killed has left
// there is removed by the next ScratchFolder of the same user.
class ScratchFolder {
 public:
  // Throws TemporaryError if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  // Makes the folder of this name, whose end mkdtemp() fills in.  Returns false if a sweep took it
  // at once.
  bool make(std::string name);

  std::filesystem::path path_;
  int lock_ = -1;  // held on the folder for as long as it is used
};

}  // namespace domefall
