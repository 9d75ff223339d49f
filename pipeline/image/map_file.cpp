#include "pipeline/image/map_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/errors.h"

namespace domefall {
namespace {

struct Descriptor {
  int fd;
  explicit Descriptor(int opened) : fd(opened) {}
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
};

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) : path_(file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (opened.fd < 0 || fstat(opened.fd, &status) != 0) throw_file_error(file, errno);
  if (!S_ISREG(status.st_mode)) throw InputError(file.string() + ": is no regular file");
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;  // nothing can be mapped
  void* mapped = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, opened.fd, 0);
  if (mapped == MAP_FAILED) throw_file_error(file, errno);
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
