// This file makes SHA-256 sums of files, in the list that `sha256sum -c` reads.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace domefall {

// Returns 64 hexadecimal digits.  Throws as RegularFile, and std::runtime_error
// if libcrypto cannot make sums.
std::string sha256_of_file(const std::filesystem::path& path);

struct ListedFile {
  std::string sha256;
  std::string path;  // below the folder of the list, with '/'

  bool operator==(const ListedFile&) const = default;
};

// Returns a line for each file, in their order.  No path may have a backslash or a newline, since
// sha256sum writes and reads these in another way.
std::string checksum_list(const std::vector<ListedFile>& files);

// Reads the list back.  Throws InputError, with the number of the line, for any other text, and for
// a path that leads out of the folder.
std::vector<ListedFile> parse_checksum_list(std::string_view text);

}  // namespace domefall
