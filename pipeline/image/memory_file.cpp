#include "pipeline/image/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "pipeline/image/atomic_file.h"

namespace domefall {

MemoryFile::MemoryFile(const std::string& purpose)
    : purpose_(purpose + " in memory"), descriptor_(memfd_create("domefall", MFD_CLOEXEC)) {
  if (number() < 0) throw_file_error(purpose_, errno);
}

void MemoryFile::append(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = write(number(), bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) throw_file_error(purpose_, errno);
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void MemoryFile::rewind() const {
  if (lseek(number(), 0, SEEK_SET) != 0) throw_file_error(purpose_, errno);
}

std::string MemoryFile::contents() const {
  std::string all;
  std::array<char, 1 << 16> piece{};
  while (true) {
    const ssize_t count =
        pread(number(), piece.data(), piece.size(), static_cast<off_t>(all.size()));
    if (count < 0 && errno != EINTR) throw_file_error(purpose_, errno);
    if (count == 0) return all;
    if (count > 0) all.append(piece.data(), static_cast<std::size_t>(count));
  }
}

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", number()); }

}  // namespace domefall
