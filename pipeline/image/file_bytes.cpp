#include "pipeline/image/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kStart = 16384;

[[noreturn]] void fail_to_open(const fs::path& path, int error) {
  const std::string what = path.string() + ": " + std::strerror(error);
  if (error == ELOOP || error == ENAMETOOLONG) throw InputError(what);
  throw TemporaryError(what);
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

// Whether there is a regular file, which is asked before it is opened: to open a device may act on
// it.
bool is_there(const fs::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISREG(status.st_mode)) return true;
    throw InputError(path.string() + ": this is " + kind_of(status.st_mode) +
                     ", and a file of that name is needed; remove or rename it");
  }
  if (errno == ENOTDIR) return false;  // a file stands where its folder would be
  if (errno != ENOENT) fail_to_open(path, errno);
  if (lstat(path.c_str(), &status) == 0)
    throw TemporaryError(path.string() + ": a link that leads nowhere; mend or remove it");
  if (errno != ENOENT) fail_to_open(path, errno);
  return false;
}

}  // namespace

FileBytes::FileBytes(int descriptor, fs::path name)
    : name_(std::move(name)), descriptor_(descriptor) {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail_to_open(name_, errno);
  if (!S_ISREG(status.st_mode)) throw InputError(name_.string() + ": is no regular file");
  size_ = static_cast<std::uint64_t>(status.st_size);
  start_ = read(0, std::min(size_, kStart));
}

FileBytes::~FileBytes() {
  if (owned_) close(descriptor_);
}

std::unique_ptr<FileBytes> FileBytes::open(const fs::path& path) {
  if (!is_there(path)) return nullptr;
  // Without waiting, since it may have become a pipe meanwhile.
  const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (opened < 0 && errno == ENOENT) return nullptr;
  if (opened < 0) fail_to_open(path, errno);
  try {
    auto file = std::make_unique<FileBytes>(opened, path);
    file->owned_ = true;
    return file;
  } catch (...) {
    close(opened);
    throw;
  }
}

std::string FileBytes::at(std::uint64_t position, std::uint64_t count) const {
  if (count > kMost || position > size_ || count > size_ - position)
    throw DamagedFile("it ends before what its beginning promises");
  if (position + count <= start_.size()) return start_.substr(position, count);
  return read(position, count);
}

std::string FileBytes::read(std::uint64_t position, std::uint64_t count) const {
  std::string bytes(count, '\0');
  std::uint64_t done = 0;
  while (done < count) {
    const ssize_t got =
        pread(descriptor_, bytes.data() + done, count - done, static_cast<off_t>(position + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw TemporaryError(name_.string() + ": reading broke off: " + std::strerror(errno));
    if (got == 0) throw DamagedFile("another program has shortened it");
    done += static_cast<std::uint64_t>(got);
  }
  return bytes;
}

}  // namespace domefall
