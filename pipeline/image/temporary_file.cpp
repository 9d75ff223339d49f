#include "pipeline/image/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <optional>
#include <string>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/descriptor.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/unfinished.h"
#include "pipeline/image/utf8.h"
#include "pipeline/image/writer_id.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".domefall-", kSuffix = ".tmp";
constexpr std::size_t kLongestStem = 40;  // some file systems allow names of 143 bytes

fs::path folder_of(const fs::path& path) {
  return path.parent_path().empty() ? "." : path.parent_path();
}

// Returns the beginning of a file's name, cut between characters, since some file systems take only
// UTF-8.
std::string stem_of(const fs::path& path) {
  std::string stem = path.filename().string();
  if (stem.size() <= kLongestStem) return stem;
  std::size_t end = kLongestStem;
  while (end > 0 && continues_character(stem[end])) --end;
  stem.resize(end);
  return stem;
}

// Returns a new name at every call.
fs::path temporary_name(const fs::path& path, std::uint64_t device) {
  static std::atomic<unsigned> count{0};
  WriterId writer = this_writer();
  writer.device = device;
  return path.parent_path() /
         fmt::format(".{}.{}-{}{}", stem_of(path), text_of(writer), count++, kSuffix);
}

// Returns nothing for a name that temporary_name() does not give.
std::optional<WriterId> writer_of_temporary(std::string_view name) {
  const auto mark = name.rfind(kMark);
  if (!name.starts_with('.') || !name.ends_with(kSuffix) || mark == std::string_view::npos ||
      mark == 0)
    return std::nullopt;
  name.remove_suffix(kSuffix.size());
  const auto count_at = name.rfind('-') + 1;
  unsigned count = 0;
  const auto [end, error] =
      std::from_chars(name.data() + count_at, name.data() + name.size(), count);
  if (error != std::errc() || fmt::to_string(count) != name.substr(count_at)) return std::nullopt;
  return writer_of(name.substr(mark + 1, count_at - 1 - (mark + 1)));
}

void refuse_to_replace_special(const fs::path& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return;
  if (S_ISDIR(status.st_mode)) throw_file_error(path, EISDIR);
  if (!S_ISREG(status.st_mode) && !S_ISLNK(status.st_mode))
    throw InputError(path.string() + ": is no regular file, and no file is put in its place");
}

bool is_abandoned(const fs::path& file, const WriterId& writer, std::uint64_t device) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  return opened.number() >= 0 && fstat(opened.number(), &status) == 0 && S_ISREG(status.st_mode) &&
         has_ended(writer, opened.number(), device);
}

void flush_folder(const fs::path& folder) {
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.number() < 0 && errno == EACCES) return;  // it may be written to and not read
  if (opened.number() < 0) throw_file_error(folder, errno);
  // Some file systems cannot flush a folder and say so.  Nothing more can be done for a rename
  // there.
  if (fsync(opened.number()) != 0 && errno != EINVAL && errno != ENOTSUP)
    throw_file_error(folder, errno);
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& path) : path_(path) {
  refuse_to_replace_special(path);
  constexpr int kMostTries = 8;
  std::uint64_t device = device_of(folder_of(path));
  create(device);
  for (int tries = 1; device != 0 && !lock(); ++tries) {
    // A sweep was quicker than the lock, or there are no locks here, which the next name tells.
    if ((errno != EWOULDBLOCK && errno != 0) || tries == kMostTries) device = 0;
    discard();
    create(device);
  }
}

TemporaryFile::~TemporaryFile() {
  if (!in_place_)
    discard();
  else
    close(descriptor_);
}

void TemporaryFile::create(std::uint64_t device) {
  constexpr unsigned kMode = 0666;
  UnfinishedList unfinished;
  temporary_ = temporary_name(path_, device);
  descriptor_ = open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  // Failures are told under the name that the user knows.
  if (descriptor_ < 0) throw_file_error(path_, errno);
  unfinished.add(temporary_);
}

// Returns false with errno where it cannot be locked, and with 0 where it has lost its name.
bool TemporaryFile::lock() const {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) return false;
  struct stat status {};
  errno = 0;
  return fstat(descriptor_, &status) == 0 && status.st_nlink > 0;
}

void TemporaryFile::discard() {
  UnfinishedList unfinished;
  unlink(temporary_.c_str());
  close(descriptor_);
  unfinished.drop(temporary_);
}

void TemporaryFile::put_in_place() {
  {
    UnfinishedList unfinished;
    if (rename(temporary_.c_str(), path_.c_str()) != 0) throw_file_error(path_, errno);
    unfinished.drop(temporary_);
    in_place_ = true;
  }
  flush_folder(folder_of(path_));
}

int sweep_temporaries(const fs::path& folder) {
  const std::uint64_t device = device_of(folder);
  int removed = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto writer = writer_of_temporary(entry->path().filename().string());
    if (writer && is_abandoned(entry->path(), *writer, device) &&
        unlink(entry->path().c_str()) == 0)
      ++removed;
  }
  return removed;
}

}  // namespace domefall
