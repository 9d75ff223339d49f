// This is the one way in which Domefall opens a file that it reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace domefall {

// A RegularFile is a regular file, open for reading.  A folder, a pipe, a socket or a device is
// refused before it is opened, since to open or read one may wait for ever, and may act on a
// device.  Nothing is read beyond the size that the file had when it was opened.  So a file of
// /proc, which calls itself empty and may wait for news (/proc/kmsg), is empty.
class RegularFile {
 public:
  // Throws InputError for what is no regular file and for a name that no machine can open, and
  // TemporaryError for a file that is missing or may not be read and for a link that leads nowhere,
  // which another machine may have.  Both name the file.
  explicit RegularFile(const std::filesystem::path& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile(RegularFile&&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;
  RegularFile& operator=(RegularFile&&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint64_t size() const { return size_; }  // bytes

  // Reads the next bytes, at most `count`, and returns how many there were, which is 0 at the end.
  // Throws TemporaryError where the system fails.
  std::size_t read(char* bytes, std::size_t count);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0, position_ = 0;
};

// Reads bytes of an open file from `position` on, and returns how many there were, which is fewer
// than `count` at its end.  Throws TemporaryError, naming `path`, where the system fails.
std::size_t read_at(int descriptor, const std::filesystem::path& path, std::uint64_t position,
                    char* bytes, std::size_t count);

// Returns the whole of a file.  Throws as RegularFile, and InputError if it has more than `most`
// bytes.
std::string read_file(const std::filesystem::path& path, std::uint64_t most);

// Returns a file's first bytes, at most `count`.  Throws as RegularFile.
std::string start_of_file(const std::filesystem::path& path, std::size_t count);

// Says whether a file is of a binary format.  Its first bytes tell or, where it is shorter than the
// format's header, its extension (".sky"), so that it is said to be cut short and not taken for a
// file of another kind.  Throws as RegularFile.
bool is_of_format(const std::filesystem::path& path, std::string_view first_bytes,
                  std::string_view extension, std::size_t header_bytes);

// Says whether a regular file is there and may be read.  It is not opened.
bool is_readable_file(const std::filesystem::path& path);

// Checks a file that the command line names, which is a mistake where the file is missing or may
// not be read.  Throws InputError for these, and as RegularFile besides.  Returns the path.
const std::filesystem::path& require_file(const std::filesystem::path& path);

}  // namespace domefall
