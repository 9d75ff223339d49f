// Catalogues and maps of the sky are handed on packed by gzip.  They are known by their first
// bytes, whatever they are called, and are unpacked in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "pipeline/base/regular_file.h"

namespace domefall {

// No more is unpacked, so that a small file cannot fill the memory.  AT-HYG, the largest catalogue
// that comes as one packed file, has 0.6 GiB.
inline constexpr std::uint64_t kMostUnpacked = std::uint64_t{2} << 30;

bool is_gzip(std::string_view bytes);

// Returns what the bytes of a gzip file hold.  Throws InputError, which names the file, if it is
// damaged, cut short, or holds more than `most` bytes.
std::string unpacked(std::string_view bytes, const std::filesystem::path& file,
                     std::uint64_t most = kMostUnpacked);

// Returns the first bytes of a file, at most `count`, of what it holds if it is packed.  Throws as
// RegularFile and as unpacked().
std::string start_of_unpacked(const std::filesystem::path& file, std::size_t count);

class UnpackedFile {
 public:
  // Maps a file, and unpacks it if it is packed.  Throws as MappedFile and as unpacked().
  explicit UnpackedFile(const std::filesystem::path& file);

  std::string_view bytes() const { return packed_ ? unpacked_ : file_.bytes(); }
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  MappedFile file_;
  bool packed_;
  std::string unpacked_;
};

}  // namespace domefall
