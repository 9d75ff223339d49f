// A FileStamp tells, without reading a file, whether the file may have changed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace domefall {

// Two stamps of a path differ if in between anything wrote to the file, replaced or renamed it, or
// changed its permissions, even if the change was undone.  The reason is that only the system can
// set the time of the last change of state (ctime).  A path without a file has a stamp of its own.
// Changes within a few milliseconds of each other, the resolution of the system's clock, may get
// the same stamp.
struct FileStamp {
  explicit FileStamp(const std::filesystem::path& file);
  bool operator==(const FileStamp&) const = default;

  std::uint64_t device = 0, number = 0, size = 0;  // `number` is that of the inode
  std::int64_t written_s = 0, written_ns = 0, changed_s = 0, changed_ns = 0;
};

}  // namespace domefall
