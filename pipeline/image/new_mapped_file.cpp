#include "pipeline/image/new_mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>

#include <cerrno>

#include "pipeline/image/atomic_file.h"

namespace domefall {

NewMappedFile::NewMappedFile(const std::filesystem::path& path, std::size_t size)
    : file_(path), size_(size) {
  int error = 0;
  do error = posix_fallocate(file_.descriptor(), 0, static_cast<off_t>(size));
  while (error == EINTR);
  if (error != 0) throw_file_error(path, error);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_.descriptor(), 0);
  if (memory == MAP_FAILED) throw_file_error(path, errno);
  data_ = static_cast<std::byte*>(memory);
}

NewMappedFile::~NewMappedFile() { munmap(data_, size_); }

void NewMappedFile::commit() {
  if (msync(data_, size_, MS_SYNC) != 0) throw_file_error(file_.path(), errno);
  file_.put_in_place();
}

}  // namespace domefall
