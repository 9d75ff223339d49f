// A WriterId says who writes a file that is not finished, as its name has it.  This is enough to
// tell the living from the dead.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace domefall {

struct WriterId {
  // These are the first 64 bits of the kernel's boot id, which stand for a machine since it was
  // last started, with all its containers.  They are 0 where it is not known, and then it equals no
  // other.
  std::uint64_t boot = 0;
  // This is the file system (st_dev of the folder) where the writer holds a lock on the file, or 0
  // where none could be had.
  std::uint64_t device = 0;
  std::uint64_t process_namespace = 0;  // the inode of its PID namespace
  pid_t process = 0;                    // its number in that namespace
  std::uint64_t start = 0;  // when it started, in clock ticks since the machine did; else random

  bool operator==(const WriterId&) const = default;
};

// Returns this process, with no device.
WriterId this_writer();

// Returns "domefall-<boot>-<device>-<process_namespace>-<process>-<start>", with the first three in
// hexadecimal.
std::string text_of(const WriterId& id);
// Returns nothing for any text that text_of() does not return.
std::optional<WriterId> writer_of(std::string_view text);

// Returns WriterId::device of what lies in a folder, or 0 where the folder cannot be asked.
std::uint64_t device_of(const std::filesystem::path& folder);

// Says whether whoever began what `descriptor` is open on, a file or a folder that lies on
// `device`, has surely ended.  On the machine that asks, a process ends with its locks, so a free
// lock tells, in any PID namespace.  Without locks (some file servers know none) the process number
// and the start tell, within a namespace.  Of other machines, and of earlier boots, only a week
// without a change tells.  A lock that is held always says no.
bool has_ended(const WriterId& id, int descriptor, std::uint64_t device);

}  // namespace domefall
