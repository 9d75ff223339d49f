// FileBytes are the bytes of a file at any place, for readers that must not believe what the file
// says of itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "pipeline/image/regular_file.h"

namespace domefall {

// DamagedFile says that what was read makes no sense as what it should be.  The file is damaged, or
// of another kind.
struct DamagedFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class FileBytes {
 public:
  // Takes a file that is open already, and stays so for as long as this lives.
  FileBytes(int descriptor, std::filesystem::path name);
  ~FileBytes() = default;
  FileBytes(const FileBytes&) = delete;
  FileBytes(FileBytes&&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;
  FileBytes& operator=(FileBytes&&) = delete;

  // Opens a regular file, and returns null if nothing has that name.  Throws as RegularFile.
  static std::unique_ptr<FileBytes> open(const std::filesystem::path& path);

  std::uint64_t size() const { return size_; }

  // Returns the bytes position to position + count - 1.  Throws DamagedFile unless the file has
  // them and they are at most kMost, and TemporaryError where the system fails.
  std::string at(std::uint64_t position, std::uint64_t count) const;
  static constexpr std::uint64_t kMost = std::uint64_t{16} << 20;

 private:
  FileBytes(std::unique_ptr<const RegularFile> file, std::filesystem::path name);
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
