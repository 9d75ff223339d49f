// These functions put files of a delivery where they belong.
#pragma once

#include <filesystem>

namespace domefall {

// Copies a file.  The copy appears whole or not at all.  Throws as RegularFile and NewFile.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Makes a hard link, which takes no room, or copies the file where the file system has no hard
// links or the two paths lie on different file systems.  What was at `to` is replaced.  Throws as
// copy_whole_file().
void link_or_copy_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Makes a folder and those above it, and removes what dead writers left in it.  Throws InputError
// where a file is in the way, else TemporaryError.
void make_delivery_folder(const std::filesystem::path& folder);

// Has the names in a folder written to the disk.  Throws as throw_file_error().
void flush_folder(const std::filesystem::path& folder);

}  // namespace domefall
