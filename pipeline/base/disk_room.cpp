#include "pipeline/base/disk_room.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <iterator>
#include <system_error>

#include "pipeline/base/errors.h"

namespace domefall {
namespace {

namespace fs = std::filesystem;

double bytes_below(const fs::path& folder) {
  double bytes = 0;
  std::error_code error;  // what cannot be read counts for nothing
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored)) continue;
    const std::uintmax_t size = entry->file_size(ignored);
    if (!ignored) bytes += static_cast<double>(size);
  }
  return bytes;
}

fs::path nearest_there(const fs::path& path) {
  std::error_code error;
  fs::path there = fs::absolute(path, error);
  while (!fs::exists(there, error) && there != there.root_path()) there = there.parent_path();
  return there;
}

// Returns what the disk of a path has free, which need not be there yet.
std::optional<double> free_bytes(const fs::path& path) {
  std::error_code error;
  const fs::space_info space = fs::space(nearest_there(path), error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

}  // namespace

std::optional<DiskRoom> disk_room(const fs::path& folder) {
  const auto free = free_bytes(folder);
  if (!free) return std::nullopt;
  return DiskRoom{folder, *free, bytes_below(folder)};
}

void require_room(const fs::path& path, double least, const std::string& what) {
  const auto free = free_bytes(path);
  if (!free || least <= *free) return;
  throw TemporaryError(
      fmt::format("{}: {} free on this disk, and {}", path.string(), bytes_text(*free), what));
}

void require_writable(const fs::path& path) {
  struct stat about {};
  if (lstat(path.c_str(), &about) != 0 && errno != ENOENT && errno != ENOTDIR)
    throw_file_error(path, errno);
  const fs::path there = nearest_there(path);
  if (access(there.c_str(), W_OK) != 0) throw_file_error(there, errno);
}

bool is_same_disk(const fs::path& a, const fs::path& b) {
  struct stat of_a {
  }, of_b{};
  return stat(nearest_there(a).c_str(), &of_a) == 0 && stat(nearest_there(b).c_str(), &of_b) == 0 &&
         of_a.st_dev == of_b.st_dev;
}

std::string bytes_text(double bytes) {
  constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(kUnits); ++unit) bytes /= 1000;
  return fmt::format("{:.3g} {}", bytes, kUnits[unit]);
}

}  // namespace domefall
