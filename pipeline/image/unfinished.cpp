#include "pipeline/image/unfinished.h"

#include <set>
#include <system_error>

namespace domefall {
namespace {

struct Unfinished {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
};

// It is never destroyed, since a signal may come while the program's other objects are.
Unfinished& unfinished() {
  static auto& all = *new Unfinished;
  return all;
}

}  // namespace

UnfinishedList::UnfinishedList() : held_(unfinished().mutex) {}

void UnfinishedList::add(const std::filesystem::path& path) { unfinished().paths.insert(path); }

void UnfinishedList::drop(const std::filesystem::path& path) { unfinished().paths.erase(path); }

void remove_unfinished() noexcept {
  Unfinished& all = unfinished();
  all.mutex.lock();  // and never unlocked
  // Other threads still run, so a folder is not empty where one of them makes a file in it
  // meanwhile.
  constexpr int kMostTries = 100;
  for (const std::filesystem::path& path : all.paths) {
    std::error_code error;
    for (int tries = 0; tries < kMostTries; ++tries)
      if (std::filesystem::remove_all(path, error); error != std::errc::directory_not_empty) break;
  }
}

}  // namespace domefall
