// Whether a file may have changed, told without reading it.
#pragma once

#include <cstdint>
#include <filesystem>

namespace domefall {

// Two stamps of a path differ if anything has written to the file, replaced or renamed it, or
// changed its rights in between, even if it was put back: the system sets the time of the last
// change of state, and no program can.  A path without a file has a stamp of its own.  Changes
// within a few milliseconds of each other, the grain of the system's clock, may bear one stamp.
struct FileStamp {
  explicit FileStamp(const std::filesystem::path& file);
  bool operator==(const FileStamp&) const = default;

  std::uint64_t device = 0, number = 0, size = 0;
  std::int64_t written_s = 0, written_ns = 0, changed_s = 0, changed_ns = 0;
};

}  // namespace domefall
