#include "pipeline/image/file_bytes.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "pipeline/image/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kStart = 16384;

std::uint64_t size_of(int descriptor, const fs::path& name) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0)
    throw TemporaryError(name.string() + ": " + std::strerror(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace

FileBytes::FileBytes(int descriptor, fs::path name)
    : name_(std::move(name)), descriptor_(descriptor), size_(size_of(descriptor, name_)) {
  start_ = read(0, std::min(size_, kStart));
}

FileBytes::FileBytes(std::unique_ptr<const RegularFile> file, fs::path name)
    : FileBytes(file->descriptor(), std::move(name)) {
  opened_ = std::move(file);
}

std::unique_ptr<FileBytes> FileBytes::open(const fs::path& path) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return nullptr;
  return std::unique_ptr<FileBytes>(new FileBytes(std::make_unique<const RegularFile>(path), path));
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
