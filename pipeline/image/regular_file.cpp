#include "pipeline/image/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

// Throws as throw_file_error(), which the library of image formats does not have.
[[noreturn]] void fail_to_open(const fs::path& path, int error) {
  const std::string what = path.string() + ": " + std::strerror(error);
  if (error == ENAMETOOLONG || error == ELOOP) throw InputError(what);
  throw TemporaryError(what);
}

const char* kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

void check_regular(const fs::path& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode))
    throw InputError(path.string() + ": this is " + kind_of_file(status.st_mode) +
                     "; only regular files can be read");
}

}  // namespace

RegularFile::RegularFile(const fs::path& path) : path_(path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    const int error = errno;
    if (error == ENOENT && lstat(path.c_str(), &status) == 0)
      throw TemporaryError(path.string() + ": a link that leads nowhere");
    fail_to_open(path, error);
  }
  check_regular(path, status);
  // It is opened without waiting, since the file may have become a pipe meanwhile.
  descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) fail_to_open(path, errno);
  try {
    if (fstat(descriptor_, &status) != 0) fail_to_open(path, errno);
    check_regular(path, status);
  } catch (...) {
    close(descriptor_);
    throw;
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

RegularFile::~RegularFile() { close(descriptor_); }

std::size_t RegularFile::read(char* bytes, std::size_t count) {
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - position_));
  const std::size_t done = read_at(descriptor_, path_, position_, bytes, count);
  position_ += done;
  return done;
}

std::size_t read_at(int descriptor, const fs::path& path, std::uint64_t position, char* bytes,
                    std::size_t count) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        pread(descriptor, bytes + done, count - done, static_cast<off_t>(position + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw TemporaryError(path.string() + ": reading broke off: " + std::strerror(errno));
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string read_file(const fs::path& path, std::uint64_t most) {
  RegularFile file(path);
  if (file.size() > most)
    throw InputError(fmt::format("{}: the file has {} bytes; at most {} can be read", path.string(),
                                 file.size(), most));
  std::string bytes(static_cast<std::size_t>(file.size()), '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

std::string start_of_file(const fs::path& path, std::size_t count) {
  RegularFile file(path);
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, file.size())), '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

bool is_of_format(const fs::path& path, std::string_view first_bytes, std::string_view extension,
                  std::size_t header_bytes) {
  const std::string start = start_of_file(path, header_bytes);
  return start.starts_with(first_bytes) ||
         (start.size() < header_bytes && path.extension() == extension);
}

bool is_readable_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && access(path.c_str(), R_OK) == 0;
}

const fs::path& require_file(const fs::path& path) {
  struct stat status {};
  const bool found = stat(path.c_str(), &status) == 0;
  if (found) check_regular(path, status);
  if (found && access(path.c_str(), R_OK) == 0) return path;
  if (errno == ENOENT || errno == EACCES || errno == ENOTDIR)
    throw InputError(path.string() + ": " + std::strerror(errno));
  fail_to_open(path, errno);
}

}  // namespace domefall
