// Files that appear whole or not at all: nothing half-written ever bears its final name, whatever
// kills the writer.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

// Writes a file under a temporary name, .NAME.<host>.<pid>.<nonce>.tmp, in the folder of `path`,
// flushes it to the disk, renames it to `path` and flushes the folder.  A file that was at `path`
// is there until the new one takes its place.  If anything fails, the temporary is removed and
// `path` is left as it was.
//
// Throws InputError for a folder that is missing or may not be written to, TemporaryError for a
// disk that is full, a quota or a file server; both name the path and the reason.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

// The temporary name, new at every call, under which a file that shall become `path` is written.
std::filesystem::path temporary_for(const std::filesystem::path& path);

// Gives a temporary, written and flushed, its final name and flushes the folder.  Throws as above.
void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

// Removes from a folder (not from those below it) the temporaries of writers that are dead: of this
// host and with a process number that is not in use, or of any host and older than a day.  Returns
// how many were removed.  A folder that cannot be read has none; nothing is thrown.
int sweep_temporaries(const std::filesystem::path& folder);

// The exception for a system call that failed on `path` with `error` (an errno), by what can be
// done about it: TemporaryError where trying again later may help, InputError where it cannot.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, int error);

}  // namespace domefall
