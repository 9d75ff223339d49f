#include "pipeline/image/new_mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

#include "pipeline/image/atomic_file.h"

namespace domefall {
namespace {

constexpr unsigned kNewFileMode = 0666;

// Tells the error of the system call that failed last, after closing what it left open.
[[noreturn]] void fail(const std::filesystem::path& path, int file) {
  const int error = errno;
  close(file);
  throw_file_error(path, error);
}

}  // namespace

NewMappedFile::NewMappedFile(const std::filesystem::path& path, std::size_t size)
    : path_(path), temporary_(temporary_for(path)), size_(size) {
  const int file = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
  if (file < 0) throw_file_error(path, errno);
  errno = posix_fallocate(file, 0, static_cast<off_t>(size));
  void* memory =
      errno ? MAP_FAILED : mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) {
    const int error = errno;
    unlink(temporary_.c_str());
    errno = error;
    fail(path, file);
  }
  data_ = static_cast<std::byte*>(memory);
  close(file);
}

NewMappedFile::~NewMappedFile() {
  munmap(data_, size_);
  if (!committed_) unlink(temporary_.c_str());
}

void NewMappedFile::commit() {
  if (msync(data_, size_, MS_SYNC) != 0) throw_file_error(path_, errno);
  put_in_place(temporary_, path_);
  committed_ = true;
}

}  // namespace domefall
