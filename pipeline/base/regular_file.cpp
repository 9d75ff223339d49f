#include "pipeline/base/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

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

int open_regular(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    const int error = errno;
    if (error == ENOENT && lstat(path.c_str(), &status) == 0)
      throw TemporaryError(path.string() + ": a link that leads nowhere");
    throw_file_error(path, error);
  }
  check_regular(path, status);
  // It is opened without waiting, since the file may have become a pipe meanwhile.
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) throw_file_error(path, errno);
  return descriptor;
}

std::string beginning_of(RegularFile& file, std::uint64_t most) {
  std::string bytes(static_cast<std::size_t>(std::min(most, file.size())), '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  return bytes;
}

constexpr std::uint64_t kStart = 16384;

std::uint64_t size_of(int descriptor, const fs::path& name) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0)
    throw TemporaryError(name.string() + ": " + std::strerror(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace

void throw_file_error(const fs::path& path, int error) {
  const std::string what = path.string() + ": " + std::strerror(error);
  if (error == EISDIR || error == ENAMETOOLONG || error == ELOOP) throw InputError(what);
  throw TemporaryError(what);
}

RegularFile::RegularFile(const fs::path& path) : path_(path), descriptor_(open_regular(path)) {
  struct stat status {};
  if (fstat(descriptor(), &status) != 0) throw_file_error(path, errno);
  check_regular(path, status);
  size_ = static_cast<std::uint64_t>(status.st_size);
}

std::size_t RegularFile::read(char* bytes, std::size_t count) {
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - position_));
  const std::size_t done = read_at(descriptor(), path_, position_, bytes, count);
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

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string read_file(const fs::path& path, std::uint64_t most) {
  RegularFile file(path);
  if (file.size() > most)
    throw InputError(fmt::format("{}: the file has {} bytes; at most {} can be read", path.string(),
                                 file.size(), most));
  return beginning_of(file, most);
}

std::string start_of_file(const fs::path& path, std::size_t count) {
  RegularFile file(path);
  return beginning_of(file, count);
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
  throw_file_error(path, errno);
}

void Unmap::operator()(void* place) const { munmap(place, bytes); }

MappedFile::MappedFile(const fs::path& file) : path_(file) {
  const RegularFile opened(file);
  const auto size = static_cast<std::size_t>(opened.size());
  if (size == 0) return;  // nothing can be mapped
  void* mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, opened.descriptor(), 0);
  if (mapped == MAP_FAILED)
    throw TemporaryError(file.string() + ": cannot be mapped: " + std::strerror(errno));
  memory_ = MappedMemory(mapped, Unmap{size});
}

FileBytes::FileBytes(int descriptor, fs::path name)
    : name_(std::move(name)), descriptor_(descriptor), size_(size_of(descriptor, name_)) {
  start_ = read(0, std::min(size_, kStart));
}

std::optional<FileBytes> FileBytes::open(const fs::path& path) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return std::nullopt;
  auto file = std::make_unique<const RegularFile>(path);
  std::optional<FileBytes> bytes(std::in_place, file->descriptor(), path);
  bytes->opened_ = std::move(file);
  return bytes;
}

std::string FileBytes::at(std::uint64_t position, std::uint64_t count) const {
  if (count > kMost || position > size_ || count > size_ - position)
    throw DamagedFile("it ends before what its beginning promises");
  if (position + count <= start_.size()) return start_.substr(position, count);
  return read(position, count);
}

std::string FileBytes::read(std::uint64_t position, std::uint64_t count) const {
  std::string bytes(count, '\0');
  if (read_at(descriptor_, name_, position, bytes.data(), bytes.size()) < bytes.size())
    throw DamagedFile("another program has shortened it");
  return bytes;
}

}  // namespace domefall
