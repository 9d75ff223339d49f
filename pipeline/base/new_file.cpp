#include "pipeline/base/new_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace domefall {
namespace {

// Encoders write some bytes at a time.  The system is handed this many.
constexpr std::size_t kPending = std::size_t{256} << 10;

void write_at(int file, const std::filesystem::path& path, std::string_view rest,
              std::uint64_t position) {
  while (!rest.empty()) {
    const ssize_t written = pwrite(file, rest.data(), rest.size(), static_cast<off_t>(position));
    if (written < 0 && errno != EINTR) throw_file_error(path, errno);
    if (written <= 0) continue;
    rest.remove_prefix(static_cast<std::size_t>(written));
    position += static_cast<std::uint64_t>(written);
  }
}

}  // namespace

void NewFile::write_pending() noexcept {
  if (!error_) try {
      write_at(file_.descriptor(), file_.path(), pending_, written_to_);
    } catch (...) {
      error_ = std::current_exception();
    }
  size_ = size(), written_to_ = position();
  pending_.clear();
}

void NewFile::write(std::string_view piece) noexcept {
  if (error_) return;
  try {
    while (!piece.empty()) {
      const std::string_view part = piece.substr(0, kPending - pending_.size());
      pending_ += part;
      piece.remove_prefix(part.size());
      if (pending_.size() == kPending) write_pending();
    }
  } catch (...) {
    error_ = std::current_exception();
  }
}

void NewFile::seek(std::uint64_t position) noexcept {
  if (position == this->position()) return;
  write_pending();
  written_to_ = position;
}

int NewFile::flush() noexcept {
  write_pending();
  return file_.descriptor();
}

void NewFile::commit() {
  write_pending();
  if (error_) std::rethrow_exception(error_);
  // Some file systems cannot flush and say so.
  if (fsync(file_.descriptor()) != 0 && errno != EINVAL && errno != ENOTSUP)
    throw_file_error(file_.path(), errno);
  file_.put_in_place();
}

void write_atomically(const std::filesystem::path& path, std::string_view contents) {
  NewFile file(path);
  file.write(contents);
  file.commit();
}

NewMappedFile::NewMappedFile(const std::filesystem::path& path, std::size_t size) : file_(path) {
  int error = 0;
  do error = posix_fallocate(file_.descriptor(), 0, static_cast<off_t>(size));
  while (error == EINTR);
  if (error != 0) throw_file_error(path, error);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_.descriptor(), 0);
  if (memory == MAP_FAILED) throw_file_error(path, errno);
  memory_ = MappedMemory(memory, Unmap{size});
}

void NewMappedFile::commit() {
  if (msync(data(), size(), MS_SYNC) != 0) throw_file_error(file_.path(), errno);
  file_.put_in_place();
}

}  // namespace domefall
