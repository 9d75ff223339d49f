// This file makes files under temporary names, and says what becomes of those whose writer died.
#pragma once

#include <cstdint>
#include <filesystem>

namespace domefall {

// A TemporaryFile is an empty file beside `path`, open for reading and writing and locked for as
// long as this lives.  Its name is .NAME.domefall-<who writes it>-<count>.tmp, where NAME is the
// beginning of that of `path` (writer_id.h).  It is removed if it does not become `path`, also
// where a signal ends the program.
class TemporaryFile {
 public:
  // Throws InputError where `path` is something that no file may replace, such as a folder, a
  // device or a pipe.  Throws as throw_file_error() where no file can be made.
  explicit TemporaryFile(const std::filesystem::path& path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& path() const { return path_; }

  // Gives the file, written and flushed, its name, once, and flushes the folder.  Throws as
  // throw_file_error().  A file that was at `path` is then still there.
  void put_in_place();

 private:
  void create(std::uint64_t device);
  bool lock() const;
  void discard();

  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

// Removes from a folder (not from those below it) the files that TemporaryFile made and whose
// writers have surely ended (has_ended() in writer_id.h), and nothing else.  Returns how many were
// removed.  A folder that cannot be read has none.  Nothing is thrown.
int sweep_temporaries(const std::filesystem::path& folder);

}  // namespace domefall
