// These files are written as memory, for what is larger than memory may be.  map_file.h reads them.
#pragma once

#include <cstddef>
#include <filesystem>

#include "pipeline/image/temporary_file.h"

namespace domefall {

// A NewMappedFile is a file in the making, zeroed, that appears under its name when it is whole.
class NewMappedFile {
 public:
  // The disk's space is taken at once, so that a full disk is told here (TemporaryError) and not by
  // a signal later.  Throws as TemporaryFile does.
  NewMappedFile(const std::filesystem::path& path, std::size_t size);
  ~NewMappedFile();
  NewMappedFile(const NewMappedFile&) = delete;
  NewMappedFile(NewMappedFile&&) = delete;
  NewMappedFile& operator=(const NewMappedFile&) = delete;
  NewMappedFile& operator=(NewMappedFile&&) = delete;

  std::byte* data() { return data_; }
  std::size_t size() const { return size_; }

  // Flushes the file to the disk and gives it its name, once.
  void commit();

 private:
  TemporaryFile file_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace domefall
