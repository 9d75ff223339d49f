// Files that appear whole or not at all: nothing half-written ever bears its final name, whatever
// kills the writer.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

// Writes a file under a temporary name in the folder of `path` (temporary_file.h), flushes it to the
// disk, renames it to `path` and flushes the folder.  A file that was at `path` is there until the
// new one takes its place.  If anything fails, the temporary is removed and `path` is left as it
// was.  Throws as TemporaryFile does.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

// The exception for a system call that failed on `path` with `error` (an errno), by what can be
// done about it: TemporaryError where trying again later may help, InputError where it cannot.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, int error);

}  // namespace domefall
