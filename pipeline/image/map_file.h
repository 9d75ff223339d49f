// A mapped file's bytes stay where the operating system keeps them.  Pages are read from the disk
// when they are first touched, and shared by all who map the same file.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

class MappedFile {
 public:
  // Maps a file.  Throws as RegularFile, and TemporaryError where the system cannot map the file.
  // A file that another program shortens while it is mapped ends the process (SIGBUS).  Files
  // written by write_atomically are replaced, never shortened.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile(MappedFile&&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  MappedFile& operator=(MappedFile&&) = delete;

  // The bytes begin on a page's boundary.
  std::string_view bytes() const { return {data_, size_}; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace domefall
