// These functions make files that appear whole or not at all.  Nothing half-written ever bears its
// final name, whatever kills the writer.
#pragma once

#include <filesystem>
#include <string_view>

namespace domefall {

// Writes a file under a temporary name in the folder of `path` (temporary_file.h), flushes it to
// the disk, renames it to `path` and flushes the folder.  A file that was at `path` is there until
// the new one takes its place.  If anything fails, the temporary is removed and `path` is left as
// it was.  Throws as TemporaryFile does.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

// Throws what a system call that failed on `path` with `error` (an errno) comes to, with both in
// the message.  That is InputError where the path itself can never be right, because it is too
// long, leads in a circle or names a folder.  Anything else is TemporaryError, since it can be
// another way on another machine or a minute later.  A disk that is full and a folder that is not
// mounted or may not be written to are such cases.
[[noreturn]] void throw_file_error(const std::filesystem::path& path, int error);

}  // namespace domefall
