#include "pipeline/image/map_file.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>

#include "pipeline/image/errors.h"
#include "pipeline/image/regular_file.h"

namespace domefall {

MappedFile::MappedFile(const std::filesystem::path& file) : path_(file) {
  const RegularFile opened(file);
  size_ = static_cast<std::size_t>(opened.size());
  if (size_ == 0) return;  // nothing can be mapped
  void* mapped = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, opened.descriptor(), 0);
  if (mapped == MAP_FAILED)
    throw TemporaryError(file.string() + ": cannot be mapped: " + std::strerror(errno));
  data_ = static_cast<const char*>(mapped);
}

MappedFile::~MappedFile() {
  if (data_) munmap(const_cast<char*>(data_), size_);
}

}  // namespace domefall
