// An OutputFile is the file that a verb writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "pipeline/base/temporary_file.h"

namespace domefall {

// Its path is what --out or a similar option names.  A regular file is made, or replaced, when its
// content is whole.  A symbolic link is followed when the verb begins, which standard error is told
// of.  The link stays, and the file at its end is made or replaced.  A pipe, a terminal or another
// character device is written into when the content is whole.  So is what the program's own
// descriptors lead to (/dev/stdout, /dev/fd/3).
class OutputFile {
 public:
  // Removes what dead writers have left beside the file.  Throws InputError for a folder, a disk, a
  // socket and links in a circle.  Throws TemporaryError for a pipe that nobody reads within a
  // second.  Otherwise throws as throw_file_error().
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Returns where the verb is to write a file, whole or not at all.
  const std::filesystem::path& path() const { return path_; }

  // Has to be called when the content is there.  Throws as throw_file_error().
  void finish();

 private:
  std::filesystem::path named_, path_;
  int stream_ = -1;                       // of what is no regular file, or else -1
  std::optional<ScratchFolder> scratch_;  // holds the content of a stream
};

// Writes an OutputFile at once.  Throws as it does.
void write_output(const std::filesystem::path& path, std::string_view contents);

// Throws InputError if `out` is, under this or another name, the file that is to be read.
void refuse_overwriting(const std::filesystem::path& out, const std::filesystem::path& input);

}  // namespace domefall
