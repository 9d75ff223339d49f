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

bool is_cut_short(const std::filesystem::path& file, std::string_view extension,
                  std::size_t header_bytes) {
  std::error_code error;
  return file.extension() == extension && std::filesystem::is_regular_file(file, error) &&
         std::filesystem::file_size(file, error) < header_bytes && !error;
}

void fail_cut_short(const std::filesystem::path& file, std::string_view extension,
                    std::size_t bytes, std::size_t header_bytes) {
  throw InputError(file.string() + ": not a " + std::string(extension) +
                   " file: shorter than its header (" + std::to_string(bytes) +
                   " bytes instead of " + std::to_string(header_bytes) + " and more)");
}

}  // namespace domefall
