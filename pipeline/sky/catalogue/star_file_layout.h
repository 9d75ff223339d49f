// These structures are the bytes of a .stars file, which star_file.h describes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace domefall {

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

}  // namespace domefall
