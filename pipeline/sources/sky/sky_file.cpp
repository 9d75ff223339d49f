#include "pipeline/sources/sky/sky_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/base/regular_file.h"

namespace domefall {
namespace {

static_assert(std::endian::native == std::endian::little, "maps are used as they lie on the disk");

constexpr std::array<char, 8> kMagic{'D', 'O', 'M', 'E', 'S', 'K', 'Y', 0};
constexpr std::uint32_t kVersion = 1;
// A mapped file begins on a page of memory, so parts at multiples of 4096 bytes are aligned as they
// are in memory.
constexpr std::size_t kPage = 4096, kMostText = 65536;
// These bits of Header::panorama say how the panorama lies.
constexpr std::uint32_t kGalactic = 1, kLongitudeRight = 2, kSouthUp = 4, kNoPanorama = 8;

constexpr std::string_view kExtension = ".sky";
constexpr std::string_view kLimitLine = "stars: fainter than V = ";

SkyOrigin with_limit_line(SkyOrigin origin) {
  if (origin.fainter_than)
    origin.text = fmt::format("{}{:g}\n{}", kLimitLine, *origin.fainter_than, origin.text);
  return origin;
}

std::optional<double> limit_of(std::string_view text) {
  double limit = 0;
  if (!text.starts_with(kLimitLine)) return std::nullopt;
  text.remove_prefix(kLimitLine.size());
  const auto read = std::from_chars(text.data(), text.data() + text.size(), limit);
  return read.ec == std::errc() && std::isfinite(limit) ? std::optional(limit) : std::nullopt;
}

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion, header_bytes = 0;
  std::uint64_t checksum = 0, file_bytes = 0;
  double unit = 1;
  std::uint32_t kind = 0, levels = 0, panorama = kNoPanorama, text_bytes = 0;
  double centre_deg = 0;
};
static_assert(sizeof(Header) == 64);

// Each level has an entry, with one checksum for each face, so that a part of a file can be
// verified.
struct LevelEntry {
  std::uint32_t size, zero;
  std::uint64_t offset;
  std::array<std::uint64_t, 6> checksum;
};
static_assert(sizeof(LevelEntry) == 64);

// A map has a level for every power of two from kLargestFace down to 1.
constexpr std::size_t kMostLevels = std::bit_width(static_cast<unsigned>(kLargestFace));
constexpr std::size_t kMostHeader =
    (sizeof(Header) + kMostLevels * sizeof(LevelEntry) + kMostText + kPage - 1) / kPage * kPage;

// Every part begins on a page, so that levels are mapped as they lie in the file.
std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

std::size_t level_bytes(int size) { return 6 * SkyLevel::face_texels(size) * sizeof(SkyTexel); }

std::size_t header_bytes(std::size_t levels, std::size_t text) {
  return whole_pages(sizeof(Header) + levels * sizeof(LevelEntry) + text);
}

std::size_t file_bytes(int size, std::size_t text) {
  const std::vector<int> sizes = level_sizes(size);
  std::size_t bytes = header_bytes(sizes.size(), text);
  for (const int n : sizes) bytes += whole_pages(level_bytes(n));
  return bytes;
}

// Returns the checksum of a header, which is taken with 0 in the place of the checksum.
std::uint64_t header_checksum(std::string_view header) {
  std::string copy(header);
  std::memset(copy.data() + offsetof(Header, checksum), 0, sizeof Header::checksum);
  return XXH3_64bits(copy.data(), copy.size());
}

// Returns the checksum of a face with its border, since samples use that too.
std::uint64_t face_checksum(const SkyLevel& level, int face) {
  return XXH3_64bits(level.face(face), SkyLevel::face_texels(level.size) * sizeof(SkyTexel));
}

// Returns the levels of a map, finest first, as they lie in the file behind the header.
std::vector<SkyPyramid::Level> lay_out(std::byte* file, int size, std::size_t text) {
  const std::vector<int> sizes = level_sizes(size);
  std::vector<SkyPyramid::Level> levels;
  std::size_t offset = header_bytes(sizes.size(), text);
  for (const int n : sizes) {
    levels.push_back({n, reinterpret_cast<SkyTexel*>(file + offset)});
    offset += whole_pages(level_bytes(n));
  }
  return levels;
}

std::uint32_t panorama_flags(const std::optional<Orientation>& o) {
  if (!o) return kNoPanorama;
  return (o->frame == SkyFrame::kGalactic ? kGalactic : 0) |
         (o->longitude_right ? kLongitudeRight : 0) | (o->south_up ? kSouthUp : 0);
}

std::optional<Orientation> panorama_of(const Header& h) {
  if (h.panorama & kNoPanorama) return std::nullopt;
  return Orientation{h.panorama & kGalactic ? SkyFrame::kGalactic : SkyFrame::kEquatorial,
                     (h.panorama & kLongitudeRight) != 0, (h.panorama & kSouthUp) != 0,
                     h.centre_deg};
}

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t byte,
                       const std::string& what) {
  throw InputError(fmt::format("{}: byte {}: {}", path.string(), byte, what));
}

Header read_header(const std::filesystem::path& path, std::string_view file) {
  Header h;
  if (file.size() < sizeof h)
    throw InputError(fmt::format(
        "{}: not a .sky file: shorter than its header ({} bytes instead of {} and more)",
        path.string(), file.size(), sizeof h));
  std::memcpy(&h, file.data(), sizeof h);
  if (h.magic != kMagic) fail(path, 0, "this is not a .sky file");
  if (h.version != kVersion)
    fail(path, offsetof(Header, version),
         fmt::format("a .sky file of version {}; this Domefall reads version {}", h.version,
                     kVersion));
  // Only what finds the end of the header is believed before its checksum is right.
  if (h.header_bytes < sizeof h || h.header_bytes > kMostHeader || h.header_bytes % kPage)
    fail(path, offsetof(Header, header_bytes), "the header is damaged: its size makes no sense");
  if (file.size() < h.header_bytes) fail(path, file.size(), "the file ends within its header");
  if (header_checksum(file.substr(0, h.header_bytes)) != h.checksum)
    fail(path, offsetof(Header, checksum), "the header is damaged: its checksum is off");
  if (file.size() != h.file_bytes)
    fail(path, std::min(file.size(), static_cast<std::size_t>(h.file_bytes)),
         fmt::format("the file has {} bytes instead of {}", file.size(), h.file_bytes));
  return h;
}

// Checks the values, since a program that is wrong may have written a header with the right
// checksum.
void check_sense(const std::filesystem::path& path, const Header& h) {
  if (h.kind > static_cast<std::uint32_t>(SkyMapKind::kThermal))
    fail(path, offsetof(Header, kind), fmt::format("unknown kind of map {}", h.kind));
  if (h.levels < 1 || h.levels > kMostLevels)
    fail(path, offsetof(Header, levels), "a map has 1 to 14 levels");
  if (!(h.unit > 0) || !std::isfinite(h.unit))
    fail(path, offsetof(Header, unit), "the unit must exceed 0");
  if (h.text_bytes > kMostText || header_bytes(h.levels, h.text_bytes) != h.header_bytes)
    fail(path, offsetof(Header, text_bytes), "the header's parts do not add up");
  if (!std::isfinite(h.centre_deg))
    fail(path, offsetof(Header, centre_deg), "the middle must be a number");
}

// Reads the list of levels, of which each must begin where the one before ends.
std::vector<LevelEntry> read_entries(const std::filesystem::path& path, const Header& h,
                                     std::string_view file) {
  std::vector<LevelEntry> entries(h.levels);
  std::memcpy(entries.data(), file.data() + sizeof h, h.levels * sizeof(LevelEntry));
  std::size_t offset = h.header_bytes;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const LevelEntry& e = entries[k];
    const std::size_t at = sizeof h + k * sizeof e;
    if (e.size != 1u << (entries.size() - 1 - k)) fail(path, at, "a level is of the wrong size");
    if (e.offset != offset) fail(path, at + offsetof(LevelEntry, offset), "a level is misplaced");
    offset += whole_pages(level_bytes(static_cast<int>(e.size)));
  }
  if (offset != h.file_bytes) fail(path, offsetof(Header, file_bytes), "the levels do not add up");
  return entries;
}

// Returns the header of a map.  Its checksum and the length of the file are left to finish().
Header sky_header(const SkyMap& map, const SkyOrigin& origin) {
  Header h{.levels = static_cast<std::uint32_t>(map.levels().size()),
           .text_bytes = static_cast<std::uint32_t>(origin.text.size())};
  h.header_bytes = static_cast<std::uint32_t>(header_bytes(h.levels, h.text_bytes));
  h.unit = map.unit();
  h.kind = static_cast<std::uint32_t>(map.kind());
  h.panorama = panorama_flags(origin.panorama);
  h.centre_deg = origin.panorama ? origin.panorama->centre_deg : 0;
  return h;
}

LevelEntry entry_of(const SkyLevel& level, const std::byte* file) {
  const auto* start = reinterpret_cast<const std::byte*>(level.texels);
  LevelEntry e{
      static_cast<std::uint32_t>(level.size), 0, static_cast<std::uint64_t>(start - file), {}};
  for (int face = 0; face < 6; ++face)
    e.checksum[static_cast<std::size_t>(face)] = face_checksum(level, face);
  return e;
}

}  // namespace

NewSkyFile::NewSkyFile(const std::filesystem::path& path, SkyMapKind kind, double unit, int size,
                       SkyOrigin origin)
    : origin_(with_limit_line(std::move(origin))),
      file_(std::make_shared<NewMappedFile>(path, file_bytes(size, origin_.text.size()))),
      pyramid_(kind, unit, lay_out(file_->data(), size, origin_.text.size()), file_) {
  if (origin_.text.size() > kMostText)
    throw InputError(path.string() + ": the text about a map's source is at most 65536 bytes");
}

void NewSkyFile::finish() {
  pyramid_.finish();
  const SkyMap map = pyramid_.map();
  Header h = sky_header(map, origin_);
  h.file_bytes = file_->size();
  std::byte* at = file_->data() + sizeof h;
  for (const SkyLevel& level : map.levels()) {
    const LevelEntry e = entry_of(level, file_->data());
    std::memcpy(at, &e, sizeof e);
    at += sizeof e;
  }
  std::memcpy(at, origin_.text.data(), origin_.text.size());
  std::memcpy(file_->data(), &h, sizeof h);
  // The checksum is taken of the header as it lies in the file, text included, and then put into
  // it.
  h.checksum = header_checksum({reinterpret_cast<const char*>(file_->data()), h.header_bytes});
  std::memcpy(file_->data(), &h, sizeof h);
  file_->commit();
}

bool is_sky_file(const std::filesystem::path& path) {
  return is_of_format(path, {kMagic.data(), kMagic.size()}, kExtension, sizeof(Header));
}

// An Opened is a .sky file whose header has been checked, before SkyFile takes it apart.
struct SkyFile::Opened {
  std::shared_ptr<const MappedFile> file;
  Header header;
  std::vector<LevelEntry> entries;

  explicit Opened(const std::filesystem::path& path)
      : file(std::make_shared<const MappedFile>(path)), header(read_header(path, file->bytes())) {
    check_sense(path, header);
    entries = read_entries(path, header, file->bytes());
  }

  std::vector<SkyLevel> levels() const {
    std::vector<SkyLevel> levels;
    levels.reserve(entries.size());
    for (const LevelEntry& e : entries)
      levels.push_back({static_cast<int>(e.size),
                        reinterpret_cast<const SkyTexel*>(file->bytes().data() + e.offset)});
    return levels;
  }
  std::string text() const {
    return std::string(file->bytes().substr(sizeof(Header) + entries.size() * sizeof(LevelEntry),
                                            header.text_bytes));
  }
};

SkyFile::SkyFile(const std::filesystem::path& path) : SkyFile(Opened(path)) {}

SkyFile::SkyFile(const Opened& opened)
    : path_(opened.file->path()),
      bytes_(opened.file->bytes()),
      checksum_(opened.header.checksum),
      map_(static_cast<SkyMapKind>(opened.header.kind), opened.header.unit, opened.levels(),
           opened.file),
      origin_{opened.text(), panorama_of(opened.header), limit_of(opened.text())} {
  face_checksums_.reserve(opened.entries.size());
  for (const LevelEntry& e : opened.entries) face_checksums_.push_back(e.checksum);
}

std::string SkyFile::digest() const { return fmt::format("{:016x}", checksum_); }

void SkyFile::verify(int largest_face) const {
  for (std::size_t k = 0; k < face_checksums_.size(); ++k)
    for (int face = 0; face < 6; ++face) {
      const SkyLevel& level = map_.levels()[k];
      // No face of this level is looked at.
      if (level.size > largest_face) break;
      if (face_checksum(level, face) == face_checksums_[k][static_cast<std::size_t>(face)])
        continue;
      const auto* start = reinterpret_cast<const char*>(level.face(face));
      fail(path_, static_cast<std::size_t>(start - bytes_.data()),
           fmt::format("face {} of the level of size {} is damaged: its checksum is off", face,
                       level.size));
    }
}

}  // namespace domefall
