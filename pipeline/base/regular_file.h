// The one way in which Domefall opens a file that it reads, and its bytes: from the beginning on, at
// any place, or mapped into memory.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace domefall {

// Throws what a system call that failed on `path` with `error` (an errno) comes to, with both in
// the message.  That is InputError where the path itself can never be right, because it is too
// long, leads in a circle or names a folder.  Anything else is TemporaryError, since it can be
// another way on another machine or a minute later.  A disk that is full and a folder that is not
// mounted or may not be written to are such cases.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, int error);

// A Descriptor is a file descriptor that is closed with its owner.
class Descriptor {
 public:
  // A descriptor of -1, which open() returns where it fails, is none and closes nothing.
  explicit Descriptor(int opened) : number_(opened) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

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

  int descriptor() const { return descriptor_.number(); }
  std::uint64_t size() const { return size_; }  // bytes

  // Reads the next bytes, at most `count`, and returns how many there were, which is 0 at the end.
  // Throws TemporaryError where the system fails.
  std::size_t read(char* bytes, std::size_t count);

 private:
  std::filesystem::path path_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0, position_ = 0;
};

// Reads bytes of an open file from `position` on, and returns how many there were, which is fewer
// than `count` at its end.  Throws TemporaryError, naming `path`, where the system fails.
std::size_t read_at(int descriptor, const std::filesystem::path& path, std::uint64_t position,
                    char* bytes, std::size_t count);

// Writes bytes to an open file, pipe or device.  Returns false with errno where the system fails.
bool write_all(int descriptor, std::string_view bytes);

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

// Memory that was mapped, and is unmapped with its owner.
struct Unmap {
  std::size_t bytes = 0;
  void operator()(void* place) const;
};
using MappedMemory = std::unique_ptr<void, Unmap>;

// A mapped file's bytes stay where the operating system keeps them.  Pages are read from the disk
// when they are first touched, and shared by all who map the same file.
class MappedFile {
 public:
  // Maps a file.  Throws as RegularFile, and TemporaryError where the system cannot map the file.
  // A file that another program shortens while it is mapped ends the process (SIGBUS).  Files
  // written by write_atomically are replaced, never shortened.
  explicit MappedFile(const std::filesystem::path& file);

  // The bytes begin on a page's boundary.
  std::string_view bytes() const {
    return {static_cast<const char*>(memory_.get()), memory_.get_deleter().bytes};
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  MappedMemory memory_;
};

// DamagedFile says that what was read makes no sense as what it should be.  The file is damaged, or
// of another kind.
struct DamagedFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// FileBytes are the bytes of a file at any place, for readers that must not believe what the file
// says of itself.
class FileBytes {
 public:
  // Takes a file that is open already, and stays so for as long as this lives.
  FileBytes(int descriptor, std::filesystem::path name);

  // Opens a regular file, and returns nothing if nothing has that name.  Throws as RegularFile.
  static std::optional<FileBytes> open(const std::filesystem::path& path);

  std::uint64_t size() const { return size_; }

  // Returns the bytes position to position + count - 1.  Throws DamagedFile unless the file has
  // them and they are at most kMost, and TemporaryError where the system fails.
  std::string at(std::uint64_t position, std::uint64_t count) const;
  static constexpr std::uint64_t kMost = std::uint64_t{16} << 20;

 private:
  std::string read(std::uint64_t position, std::uint64_t count) const;

  std::filesystem::path name_;
  int descriptor_;
  std::uint64_t size_ = 0;
  std::unique_ptr<const RegularFile> opened_;  // what open() has opened
  std::string start_;                          // the first bytes, of which most are asked for
};

// These return the whole number that the first sizeof(Number) bytes hold in either byte order.
template <class Number>
Number little_endian(std::string_view bytes) {
  Number value = 0;
  for (std::size_t k = sizeof(Number); k-- > 0;)
    value = static_cast<Number>(value << 8 | static_cast<unsigned char>(bytes[k]));
  return value;
}
template <class Number>
Number big_endian(std::string_view bytes) {
  Number value = 0;
  for (std::size_t k = 0; k < sizeof(Number); ++k)
    value = static_cast<Number>(value << 8 | static_cast<unsigned char>(bytes[k]));
  return value;
}

}  // namespace domefall
