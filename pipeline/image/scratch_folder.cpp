#include "pipeline/image/scratch_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/descriptor.h"
#include "pipeline/image/errors.h"
#include "pipeline/image/unfinished.h"
#include "pipeline/image/writer_id.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "-XXXXXX";  // as mkdtemp() wants it

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

bool is_abandoned(const fs::path& folder, const WriterId& writer, std::uint64_t device) {
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  return opened.number() >= 0 && fstat(opened.number(), &status) == 0 &&
         status.st_uid == geteuid() && has_ended(writer, opened.number(), device);
}

void sweep_scratch(const fs::path& parent, std::uint64_t device) {
  std::error_code error, ignored;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto writer = writer_of_scratch(entry->path().filename().string());
    if (writer && is_abandoned(entry->path(), *writer, device))
      fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

ScratchFolder::ScratchFolder() {
  const fs::path parent = temporary_folder();
  WriterId writer = this_writer();
  writer.device = device_of(parent);
  sweep_scratch(parent, writer.device);
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

}  // namespace domefall
