// A .sky file holds a sky map on the disk.  A map of any size is used without being read as a
// whole: its levels are mapped into memory, and the disk is asked only for the pages that samples
// touch.
//
// All numbers are little-endian.  A header of whole pages is followed by the levels, finest first,
// each at a multiple of 4096 bytes and as SkyLevel has it in memory.  The header has these bytes:
//
//   0  8 bytes  "DOMESKY", 0            32  f64  unit (SkyMap::unit)
//   8  u32      version, 1              40  u32  kind (SkyMapKind)    44  u32  number of levels
//   12 u32      bytes of the header     48  u32  panorama: 1 galactic, 2 longitude to the right,
//   16 u64      checksum of the header           4 south up, 8 not from a panorama
//   24 u64      bytes of the file       52  u32  bytes of the text    56  f64  centre_deg
//   64 and on: per level u32 size, u32 0, u64 place in the file, 6 x u64 checksums of its faces;
//   then the text (UTF-8, lines "stars: fainter than V = ...", where that is known, "source: ...",
//   "licence: ..."), then zeros.
//
// Checksums are XXH3, 64 bits.  The header's own checksum is taken with 0 in its place.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/new_file.h"
#include "pipeline/sources/sky/orientation.h"
#include "pipeline/sources/sky/sky_map.h"
#include "pipeline/sources/sky/sky_pyramid.h"

namespace domefall {

// The origin says where a map came from.
struct SkyOrigin {
  std::string text;                     // source and licence, for people; up to 64 KiB
  std::optional<Orientation> panorama;  // the panorama's orientation, if the map is from one
  // The map holds the light of stars fainter than this V, and of no others.  The limit is missing
  // where it is not known.
  std::optional<double> fainter_than = {};
};

// This is a file in the making.  Its user fills the finest level of pyramid(), including the
// border, and then calls finish().
class NewSkyFile {
 public:
  // `size` is the number of texels along an edge of a face, a power of two up to kLargestFace.
  // Throws as NewMappedFile does, and InputError for a text that is too long.
  NewSkyFile(const std::filesystem::path& path, SkyMapKind kind, double unit, int size,
             SkyOrigin origin);

  const SkyPyramid& pyramid() const { return pyramid_; }
  // Makes the coarser levels, adds the checksums and puts the file in place, whole.
  void finish();

 private:
  SkyOrigin origin_;
  std::shared_ptr<NewMappedFile> file_;
  SkyPyramid pyramid_;
};

// Says whether a file is a .sky file (is_of_format).
bool is_sky_file(const std::filesystem::path& path);

// A SkyFile is a .sky file that is open.
class SkyFile {
 public:
  // Checks the header and the length of the file.  Throws InputError with file and byte for a file
  // that is no .sky file, damaged, cut short or of a newer version.  Otherwise throws as MappedFile
  // does.
  explicit SkyFile(const std::filesystem::path& path);

  // The file stays mapped as long as this map or a copy of it lives.
  const SkyMap& map() const { return map_; }
  const SkyOrigin& origin() const { return origin_; }
  std::uint64_t bytes() const { return bytes_.size(); }

  // Returns the checksum of the header as digits.  It covers the checksums of the faces, so it
  // stands for the whole file in the keys of frames.
  std::string digest() const;

  // Reads the levels that have at most `largest_face` texels along an edge, which are all levels
  // unless a limit is given.  Throws InputError with file and byte of the first face that does not
  // have its checksum.
  void verify(int largest_face = kLargestFace) const;

 private:
  struct Opened;
  explicit SkyFile(const Opened& opened);

  std::filesystem::path path_;
  std::string_view bytes_;  // kept alive by the map
  std::uint64_t checksum_;
  std::vector<std::array<std::uint64_t, 6>> face_checksums_;  // one array for each level
  SkyMap map_;
  SkyOrigin origin_;
};

}  // namespace domefall
