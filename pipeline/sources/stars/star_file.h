// The binary star catalogue, *.stars, is mapped into memory, so that a limit of magnitude touches
// only the stars that it needs.
//
// All numbers are little-endian.  Offsets and sizes are in bytes:
//
//   0    8  89 "STARS" 0D 0A          89 is no text, and 0D 0A tells of line ends that were changed
//   8    4  0x01020304                in the order of the bytes of all numbers
//   12   4  version, 1
//   16   8  size of the file
//   24   8  number of stars
//   32   8  epoch of the positions, Julian year (double)
//   40   4  size of a record, 32
//   44   4  stars in a block, 4096
//   48   8  where the index begins, 128
//   56   8  where the text begins       64   8  its size
//   72   8  where the names begin       80   8  their size
//   88   8  where the records begin, a multiple of 64
//   96   8  checksum of the text        104  8  of the names       112  8  of the index
//   120  8  checksum of bytes 0 to 119
//
//   index    for each block of records: 8 bytes checksum, 4 bytes V of its faintest star, 4 bytes 0
//   text     three lines, UTF-8: source, licence, how it was made
//   names    for each name: 4 bytes number of the star (from 0, ascending), 4 bytes length, name
//   records  brightest first: the unit vector (equatorial J2000) as 3 int32 times 2^-31; as floats
//            proper motion in right ascension (times cos Dec) and declination, mas a year, V, and
//            colour (star_colour.h); identifier (raw_catalogue.h)
//
// Checksums are XXH3, 64 bits.  A block is checked when it is first read, so that no data is used
// unchecked, and none is read for its checksum alone.
//
// Accuracy: rounding moves a direction by less than 0.1 mas.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "pipeline/base/regular_file.h"
#include "pipeline/sources/stars/raw_catalogue.h"

namespace domefall {

// These structures are the bytes of a .stars file, which star_file.h describes.

inline constexpr const char* kStarExtension = ".stars";
inline constexpr std::array<char, 8> kStarMagic{'\x89', 'S', 'T', 'A', 'R', 'S', '\r', '\n'};
inline constexpr std::uint32_t kByteOrder = 0x01020304, kStarFileVersion = 1;
// A block has 128 KiB and a checksum of its own, so that a limit of magnitude reads and checks no
// more than it needs.
inline constexpr std::uint32_t kBlockStars = 4096;
// Records begin on a line of the cache, and two of them fill one.
inline constexpr std::size_t kRecordAlignment = 64;
inline constexpr std::uint64_t kMostStars = 1u << 31;
inline constexpr std::uint32_t kLongestName = 256;
inline constexpr double kUnitLength = 2147483648.0;  // 2^31 of these units are the length 1

static_assert(std::endian::native == std::endian::little, "the file's numbers are little-endian");

struct StarFileHeader {
  std::array<char, 8> magic;
  std::uint32_t byte_order, version;
  std::uint64_t file_size, stars;
  double epoch;
  std::uint32_t record_size, block_stars;
  std::uint64_t index_at, text_at, text_size, names_at, names_size, records_at;
  std::uint64_t text_sum, names_sum, index_sum, head_sum;
};
static_assert(sizeof(StarFileHeader) == 128 && offsetof(StarFileHeader, head_sum) == 120);

// The index has one entry for each block.
struct StarBlock {
  std::uint64_t sum;
  float faintest;
  std::uint32_t zero;
};
static_assert(sizeof(StarBlock) == 16);

struct StarRecord {
  std::int32_t x, y, z;
  float pm_ra, pm_dec, v, colour;
  StarId id;
};
static_assert(sizeof(StarRecord) == 32);

// Says whether bytes begin as those of a .stars file do.
bool is_star_file(std::string_view bytes);

class StarFile {
 public:
  // Throws InputError naming the file and the byte if the file is of another kind, not whole,
  // damaged or of a newer version.  Also throws as MappedFile does.
  explicit StarFile(const std::filesystem::path& file);

  std::size_t size() const { return stars_; }
  double epoch() const { return epoch_; }
  const CatalogueText& text() const { return text_; }
  // Returns digits that stand for the whole contents of the file.
  std::string fingerprint() const;

  // Returns the stars of V <= limit, where both are compared as floats.  Throws InputError where
  // one of their blocks is damaged.
  std::span<const StarRecord> up_to(double limit) const;
  // Returns a lower bound to the number of stars of V <= limit, from the index alone.  It counts
  // those in blocks that are within the limit as a whole.
  std::size_t at_least_to(double limit) const;
  // Returns V of the faintest star, from the index alone.
  double faintest() const;
  // Returns the names of the first `stars` stars.
  std::vector<StarName> names(std::size_t stars) const;

  // Throws InputError naming the byte where a record begins.  The record is one that up_to()
  // returned.
  [[noreturn]] void fail_at(const StarRecord& record, const std::string& what) const;

 private:
  [[noreturn]] void fail(std::size_t byte, const std::string& what) const;
  std::string_view part(std::uint64_t at, std::uint64_t size, std::uint64_t sum,
                        const char* what) const;
  void check_block(std::size_t block) const;

  MappedFile file_;
  std::size_t stars_ = 0, records_at_ = 0;
  double epoch_ = 2000;
  std::string_view index_, names_;
  std::uint64_t head_sum_ = 0;
  CatalogueText text_;
};

// Writes a catalogue whose stars are sorted by brightness (sort_by_brightness) and whose numbers
// are finite and within their ranges.  The file appears whole or not at all.  Throws as
// write_atomically does.
void write_star_file(const std::filesystem::path& file, const RawCatalogue& catalogue);

}  // namespace domefall
