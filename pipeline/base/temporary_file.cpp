#include "pipeline/base/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"
#include "pipeline/base/utf8.h"
#include "pipeline/base/writer_id.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".domefall-", kSuffix = ".tmp";
constexpr std::string_view kRandom = "-XXXXXX";  // of a scratch folder, as mkdtemp() wants it
constexpr std::size_t kLongestStem = 40;         // some file systems allow names of 143 bytes

struct Unfinished {
  std::mutex mutex;
  std::set<fs::path> paths;
};

// It is never destroyed, since a signal may come while the program's other objects are.
Unfinished& unfinished() {
  static auto& all = *new Unfinished;
  return all;
}

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
  if (!S_ISREG(status.st_mode))
    throw InputError(path.string() + ": is no regular file, and no file is put in its place");
}

// Returns the first part of the path that is a link to nothing, or an empty path if there is none.
fs::path dangling_link(const fs::path& path) {
  fs::path part;
  for (const fs::path& name : path) {
    part /= name;
    std::error_code ignored;
    if (fs::is_symlink(part, ignored) && !fs::exists(part, ignored)) return part;
  }
  return {};
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (error) throw TemporaryError("there is no temporary folder (TMPDIR): " + error.message());
  return folder;
}

// Returns nothing for a name that no ScratchFolder has.
std::optional<WriterId> writer_of_scratch(std::string_view name) {
  if (name.size() < kRandom.size() || name[name.size() - kRandom.size()] != '-')
    return std::nullopt;
  return writer_of(name.substr(0, name.size() - kRandom.size()));
}

// `kind` is S_IFREG or S_IFDIR.
bool is_left_by_dead(const fs::path& path, mode_t kind, const WriterId& writer,
                     std::uint64_t device) {
  const Descriptor opened(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  return opened.number() >= 0 && fstat(opened.number(), &status) == 0 &&
         (status.st_mode & S_IFMT) == kind && (kind == S_IFREG || status.st_uid == geteuid()) &&
         has_ended(writer, opened.number(), device);
}

// Removes the temporary files of a folder, or the scratch folders in it, whose writers have ended.
int sweep(const fs::path& folder, mode_t kind, std::uint64_t device) {
  int removed = 0;
  std::error_code error, not_removed;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const auto writer = kind == S_IFREG ? writer_of_temporary(name) : writer_of_scratch(name);
    if (writer && is_left_by_dead(entry->path(), kind, *writer, device) &&
        fs::remove_all(entry->path(), not_removed) > 0 && !not_removed)
      ++removed;
  }
  return removed;
}

}  // namespace

UnfinishedList::UnfinishedList() : held_(unfinished().mutex) {}

void UnfinishedList::add(const fs::path& path) { unfinished().paths.insert(path); }

void UnfinishedList::drop(const fs::path& path) { unfinished().paths.erase(path); }

void remove_unfinished() noexcept {
  Unfinished& all = unfinished();
  all.mutex.lock();  // and never unlocked
  // Other threads still run, so a folder is not empty where one of them makes a file in it
  // meanwhile.
  constexpr int kMostTries = 100;
  for (const fs::path& path : all.paths) {
    std::error_code error;
    for (int tries = 0; tries < kMostTries; ++tries)
      if (fs::remove_all(path, error); error != std::errc::directory_not_empty) break;
  }
}

fs::path end_of_links(const fs::path& path, bool (*is_end)(const fs::path&)) {
  constexpr int kMostLinks = 40;  // as many as the kernel follows
  fs::path at = path;
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code none;
    if (!fs::is_symlink(fs::symlink_status(at, none)) || is_end(at)) return at;
    const fs::path target = fs::read_symlink(at, none);
    if (none) throw_file_error(path, none.value());
    at = target.is_absolute() ? target : at.parent_path() / target;
  }
  throw_file_error(path, ELOOP);
}

TemporaryFile::TemporaryFile(const fs::path& path) : path_(end_of_links(path)) {
  refuse_to_replace_special(path_);
  constexpr int kMostTries = 8;
  std::uint64_t device = device_of(folder_of(path_));
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

int sweep_temporaries(const fs::path& folder) { return sweep(folder, S_IFREG, device_of(folder)); }

ScratchFolder::ScratchFolder() {
  const fs::path parent = temporary_folder();
  WriterId writer = this_writer();
  writer.device = device_of(parent);
  sweep(parent, S_IFDIR, writer.device);
  constexpr int kMostTries = 8;
  // A sweep may be quicker than the lock.
  for (int tries = 1; !make(parent / (text_of(writer) + std::string(kRandom))); ++tries)
    if (tries == kMostTries) throw TemporaryError(parent.string() + ": folders vanish here");
}

bool ScratchFolder::make(std::string name) {
  UnfinishedList unfinished;
  if (mkdtemp(name.data()) == nullptr) throw_file_error(fs::path(name).parent_path(), errno);
  path_ = name;
  lock_ = open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // Where there are no locks, nobody can take the folder for abandoned while this process runs.
  const bool ours = lock_ >= 0 && (flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
                    access(name.c_str(), X_OK) == 0;
  if (ours) unfinished.add(path_);
  if (!ours && lock_ >= 0) close(lock_);
  return ours;
}

ScratchFolder::~ScratchFolder() {
  UnfinishedList unfinished;
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  unfinished.drop(path_);
  close(lock_);
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

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    const fs::path link = dangling_link(folder);
    const std::string why = error.value() == ELOOP || link.empty()
                                ? error.message()
                                : link.string() + " is a link that leads nowhere";
    const std::string what = folder.string() + ": the folder cannot be made: " + why;
    if (error.value() == ENOTDIR || error.value() == ENAMETOOLONG || error.value() == ELOOP)
      throw InputError(what);
    throw TemporaryError(what);
  }
  sweep_temporaries(folder);
}

}  // namespace domefall
