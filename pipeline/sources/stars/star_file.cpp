#include "pipeline/sources/stars/star_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/new_file.h"

namespace domefall {
namespace {

// Copies a number out of the file, because it need not be aligned there.
template <class T>
T at(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string line(text.substr(0, end));
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::size_t block_count(std::size_t stars) { return (stars + kBlockStars - 1) / kBlockStars; }

// Returns a component in units of 2^-31.  The value 1 itself would be 2^31, which no int32 holds.
std::int32_t fixed(double component) {
  return static_cast<std::int32_t>(
      std::clamp(std::round(component * kUnitLength), 1 - kUnitLength, kUnitLength - 1));
}

StarRecord record_of(const CatalogueStar& star) {
  const V3d& d = star.direction.v;
  return {fixed(d.x),  fixed(d.y), fixed(d.z),  star.pm_ra,
          star.pm_dec, star.v,     star.colour, star.id};
}

template <class T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// Returns the three lines of the text.  Line ends within one of them become blanks.
std::string packed_text(const CatalogueText& text) {
  std::string lines;
  for (std::string line : {text.source, text.licence, text.made}) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    lines += line + '\n';
  }
  return lines;
}

// Returns the table of names, in which a name is cut at kLongestName bytes.
std::string packed_names(const std::vector<StarName>& names) {
  std::string out;
  for (const StarName& name : names) {
    const std::string_view kept = std::string_view(name.name).substr(0, kLongestName);
    out += bytes_of(name.star);
    out += bytes_of(static_cast<std::uint32_t>(kept.size()));
    out += kept;
  }
  return out;
}

// Returns the index, whose entries have the checksum of a block and V of its last and faintest
// star.
std::string index_of(const std::vector<CatalogueStar>& stars, std::string_view records) {
  std::string index;
  for (std::size_t first = 0; first < stars.size(); first += kBlockStars) {
    const std::size_t count = std::min<std::size_t>(kBlockStars, stars.size() - first);
    const StarBlock block{
        checksum(records.substr(first * sizeof(StarRecord), count * sizeof(StarRecord))),
        stars[first + count - 1].v, 0};
    index += bytes_of(block);
  }
  return index;
}

// Returns the header of a file whose parts follow each other in the order of star_file.h.
StarFileHeader star_header(const RawCatalogue& catalogue, const std::string& index,
                           const std::string& text, const std::string& names) {
  StarFileHeader head{};
  head.magic = kStarMagic;
  head.byte_order = kByteOrder;
  head.version = kStarFileVersion;
  head.stars = catalogue.stars.size();
  head.epoch = catalogue.epoch;
  head.record_size = sizeof(StarRecord);
  head.block_stars = kBlockStars;
  head.index_at = sizeof head;
  head.text_at = head.index_at + index.size();
  head.text_size = text.size();
  head.names_at = head.text_at + head.text_size;
  head.names_size = names.size();
  const std::uint64_t end = head.names_at + head.names_size;
  head.records_at = (end + kRecordAlignment - 1) / kRecordAlignment * kRecordAlignment;
  head.file_size = head.records_at + head.stars * sizeof(StarRecord);
  head.text_sum = checksum(text);
  head.names_sum = checksum(names);
  head.index_sum = checksum(index);
  head.head_sum = checksum(bytes_of(head).substr(0, offsetof(StarFileHeader, head_sum)));
  return head;
}

}  // namespace

bool is_star_file(std::string_view bytes) {
  return bytes.starts_with(std::string_view(kStarMagic.data(), kStarMagic.size()));
}

void StarFile::fail(std::size_t byte, const std::string& what) const {
  throw InputError(fmt::format("{}: byte {}: {}", file_.path().string(), byte, what));
}

void StarFile::fail_at(const StarRecord& record, const std::string& what) const {
  fail(static_cast<std::size_t>(reinterpret_cast<const char*>(&record) - file_.bytes().data()),
       what);
}

std::string_view StarFile::part(std::uint64_t at, std::uint64_t size, std::uint64_t sum,
                                const char* what) const {
  const std::string_view bytes = file_.bytes();
  if (at > bytes.size() || size > bytes.size() - at)
    fail(at, fmt::format("the {} reaches beyond the end of the file", what));
  const std::string_view found = bytes.substr(at, size);
  if (checksum(found) != sum) fail(at, fmt::format("the {} is damaged", what));
  return found;
}

StarFile::StarFile(const std::filesystem::path& file) : file_(file) {
  const std::string_view bytes = file_.bytes();
  // A file that claims to be a .stars file but is shorter than the header is said to be too short,
  // and not of another kind.
  if (bytes.size() < sizeof(StarFileHeader) &&
      (is_star_file(bytes) || file.extension() == kStarExtension))
    throw InputError(fmt::format(
        "{}: not a .stars file: shorter than its header ({} bytes instead of {} and more)",
        file.string(), bytes.size(), sizeof(StarFileHeader)));
  if (!is_star_file(bytes)) fail(0, "this is no star catalogue (.stars)");
  const auto head = at<StarFileHeader>(bytes, 0);
  if (head.byte_order != kByteOrder)
    fail(offsetof(StarFileHeader, byte_order), "the numbers are in another order of bytes");
  if (head.version != kStarFileVersion)
    fail(offsetof(StarFileHeader, version),
         fmt::format("the star catalogue is of version {}; this Domefall reads version {}",
                     head.version, kStarFileVersion));
  if (checksum(bytes.substr(0, offsetof(StarFileHeader, head_sum))) != head.head_sum)
    fail(0, "the header is damaged");
  // The byte named is the one where the file ends or should end.
  if (head.file_size != bytes.size())
    fail(std::min<std::uint64_t>(head.file_size, bytes.size()),
         fmt::format("the star catalogue {}; it has {} bytes instead of {}",
                     bytes.size() < head.file_size ? "ends here" : "should end here", bytes.size(),
                     head.file_size));
  // These values decide what is read, and a wrong program may have written them with the right
  // checksum.
  if (head.stars > kMostStars || head.record_size != sizeof(StarRecord) ||
      head.block_stars != kBlockStars || head.records_at % alignof(StarRecord) != 0 ||
      head.records_at > bytes.size() ||
      (bytes.size() - head.records_at) / sizeof(StarRecord) != head.stars)
    fail(offsetof(StarFileHeader, stars), "the header contradicts itself");
  stars_ = head.stars;
  records_at_ = head.records_at;
  epoch_ = head.epoch;
  head_sum_ = head.head_sum;
  index_ = part(head.index_at, block_count(stars_) * sizeof(StarBlock), head.index_sum, "index");
  names_ = part(head.names_at, head.names_size, head.names_sum, "table of names");
  // No checksum covers the filling, whose bytes must be 0.
  const std::size_t end = head.names_at + head.names_size;
  for (std::size_t i = end; i < records_at_; ++i)
    if (bytes[i] != 0) fail(i, "the filling before the stars is damaged");
  std::string_view text = part(head.text_at, head.text_size, head.text_sum, "text");
  text_.source = next_line(text);
  text_.licence = next_line(text);
  text_.made = next_line(text);
}

// The header's checksum covers the checksums of everything else.
std::string StarFile::fingerprint() const { return fmt::format("{:016x}", head_sum_); }

// Throws InputError, with the byte where the block begins, unless its records have the checksum of
// the index.
void StarFile::check_block(std::size_t block) const {
  const std::size_t first = block * kBlockStars,
                    count = std::min<std::size_t>(kBlockStars, stars_ - first);
  const std::size_t offset = records_at_ + first * sizeof(StarRecord);
  if (checksum(file_.bytes().substr(offset, count * sizeof(StarRecord))) !=
      at<StarBlock>(index_, block * sizeof(StarBlock)).sum)
    fail(offset, "the block of stars that begins here is damaged");
}

std::span<const StarRecord> StarFile::up_to(double limit) const {
  // V is stored as a float, and the limit is rounded to one, so that a star exactly at the limit
  // counts.
  const auto faintest = static_cast<float>(limit);
  const auto* records = reinterpret_cast<const StarRecord*>(file_.bytes().data() + records_at_);
  const std::size_t blocks = block_count(stars_);
  for (std::size_t block = 0; block < blocks; ++block) {
    check_block(block);
    // The stars are sorted, so this block has the last of those within the limit.
    if (at<StarBlock>(index_, block * sizeof(StarBlock)).faintest <= faintest) continue;
    const auto* begin = records + block * kBlockStars;
    const auto* end = records + std::min<std::size_t>((block + 1) * kBlockStars, stars_);
    const auto* stop = std::upper_bound(begin, end, faintest,
                                        [](float v, const StarRecord& star) { return v < star.v; });
    return {records, stop};
  }
  return {records, stars_};
}

std::size_t StarFile::at_least_to(double limit) const {
  const auto faintest = static_cast<float>(limit);
  const std::size_t blocks = block_count(stars_);
  std::size_t whole = 0;
  while (whole < blocks && at<StarBlock>(index_, whole * sizeof(StarBlock)).faintest <= faintest)
    ++whole;
  return std::min<std::size_t>(whole * kBlockStars, stars_);
}

double StarFile::faintest() const {
  const std::size_t blocks = block_count(stars_);
  if (blocks == 0) return kBrightestV;
  return double{at<StarBlock>(index_, (blocks - 1) * sizeof(StarBlock)).faintest};
}

std::vector<StarName> StarFile::names(std::size_t stars) const {
  std::vector<StarName> found;
  for (std::size_t i = 0; i < names_.size();) {
    const std::size_t place = static_cast<std::size_t>(names_.data() - file_.bytes().data()) + i;
    constexpr std::size_t kNumbers = 2 * sizeof(std::uint32_t);
    if (names_.size() - i < kNumbers) fail(place, "a name is cut short");
    const auto star = at<std::uint32_t>(names_, i);
    // The length is compared with what is left of the table, so that no name reaches beyond it.
    const auto length = at<std::uint32_t>(names_, i + sizeof star);
    if (length > names_.size() - i - kNumbers) fail(place, "a name is cut short");
    if (star >= stars) break;
    found.push_back({star, std::string(names_.substr(i + kNumbers, length))});
    i += kNumbers + length;
  }
  return found;
}

void write_star_file(const std::filesystem::path& file, const RawCatalogue& catalogue) {
  assert(catalogue.stars.size() <= kMostStars);
  std::vector<StarRecord> records;
  records.reserve(catalogue.stars.size());
  for (const CatalogueStar& star : catalogue.stars) records.push_back(record_of(star));
  const std::string_view record_bytes(reinterpret_cast<const char*>(records.data()),
                                      records.size() * sizeof(StarRecord));
  const std::string index = index_of(catalogue.stars, record_bytes);
  const std::string text = packed_text(catalogue.text), names = packed_names(catalogue.names);
  const StarFileHeader head = star_header(catalogue, index, text, names);
  std::string bytes;
  bytes.reserve(head.file_size);
  bytes.append(bytes_of(head)).append(index).append(text).append(names);
  bytes.resize(head.records_at, '\0');
  bytes += record_bytes;
  write_atomically(file, bytes);
}

}  // namespace domefall
