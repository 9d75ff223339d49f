// These functions ask a disk what it can take, before anything is made.  A path need not be there
// yet: the nearest folder above it that is tells.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace domefall {

// DiskRoom describes the disk that a folder of frames is on, or would be on.
struct DiskRoom {
  std::filesystem::path folder;
  double free = 0, taken = 0;  // bytes; taken by what is in the folder already
};
// Returns nothing where the system does not tell.
std::optional<DiskRoom> disk_room(const std::filesystem::path& folder);

// Throws TemporaryError if the disk of a path has fewer bytes free than `least`, which is so little
// that the rest of an estimate does not matter.  `what` says what needs them, and what was assumed.
// A quota may leave less than the disk has.
void require_room(const std::filesystem::path& path, double least, const std::string& what);

// Throws as throw_file_error() if no file of this name can be made: the name is too long, or the
// disk or the folder above may not be written to.
void require_writable(const std::filesystem::path& path);

// Says whether two paths are on one file system.
bool is_same_disk(const std::filesystem::path& a, const std::filesystem::path& b);

// Returns three digits in the unit that suits, such as "850 kB" or "12.3 GB".
std::string bytes_text(double bytes);

}  // namespace domefall
