// The file that a verb writes.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "pipeline/image/scratch_folder.h"

namespace domefall {

// What --out or a like option names.  A regular file is replaced, or made, when its content is
// whole.  A symbolic link is followed when the verb begins, and said to be; it stays, and the file
// at its end is replaced or made.  Into a pipe, a terminal or another character device the content
// is written when it is whole, also into what the program's own descriptors lead to (/dev/stdout,
// /dev/fd/3).
class OutputFile {
 public:
  // Removes what dead writers have left beside the file.  Throws InputError for a folder, a disk, a
  // socket and links in a circle, TemporaryError for a pipe that nobody reads within a second, and
  // else as throw_file_error().
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;

  // Where the verb is to write a file, whole or not at all.
  const std::filesystem::path& path() const { return path_; }

  // To be called when the content is there.  Throws as throw_file_error().
  void finish();

 private:
  std::filesystem::path named_, path_;
  int stream_ = -1;                       // what is no regular file
  std::optional<ScratchFolder> scratch_;  // then holds the content
};

// Writes an OutputFile at once.  Throws as it does.
void write_output(const std::filesystem::path& path, std::string_view contents);

// Throws InputError if `out` is, under this or another name, the file that is to be read.
void refuse_overwriting(const std::filesystem::path& out, const std::filesystem::path& input);

}  // namespace domefall
