#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/digest.h"
#include "pipeline/sky/catalogue/star_file.h"
#include "pipeline/sky/catalogue/star_file_layout.h"

namespace domefall {
namespace {

std::int32_t fixed(double component) {
  return static_cast<std::int32_t>(std::clamp(std::round(component * kUnit), 1 - kUnit, kUnit - 1));
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

// The three lines; a line's end within one would make it two.
std::string text_of(const CatalogueText& text) {
  std::string lines;
  for (std::string line : {text.source, text.licence, text.made}) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    lines += line + '\n';
  }
  return lines;
}

std::string names_of(const std::vector<StarName>& names) {
  std::string out;
  for (const StarName& name : names) {
    const std::string_view kept = std::string_view(name.name).substr(0, kLongestName);
    out += bytes_of(name.star);
    out += bytes_of(static_cast<std::uint32_t>(kept.size()));
    out += kept;
  }
  return out;
}

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

StarFileHeader header_of(const RawCatalogue& catalogue, const std::string& index,
                         const std::string& text, const std::string& names) {
  StarFileHeader head{};
  head.magic = kStarMagic;
  head.byte_order = kByteOrder, head.version = kStarFileVersion;
  head.stars = catalogue.stars.size(), head.epoch = catalogue.epoch;
  head.record_size = sizeof(StarRecord), head.block_stars = kBlockStars;
  head.index_at = sizeof head;
  head.text_at = head.index_at + index.size(), head.text_size = text.size();
  head.names_at = head.text_at + head.text_size, head.names_size = names.size();
  const std::uint64_t end = head.names_at + head.names_size;
  head.records_at = (end + kRecordAlignment - 1) / kRecordAlignment * kRecordAlignment;
  head.file_size = head.records_at + head.stars * sizeof(StarRecord);
  head.text_sum = checksum(text), head.names_sum = checksum(names);
  head.index_sum = checksum(index);
  head.head_sum = checksum(bytes_of(head).substr(0, offsetof(StarFileHeader, head_sum)));
  return head;
}

}  // namespace

void write_star_file(const std::filesystem::path& file, const RawCatalogue& catalogue) {
  assert(catalogue.stars.size() <= kMostStars);
  std::vector<StarRecord> records;
  records.reserve(catalogue.stars.size());
  for (const CatalogueStar& star : catalogue.stars) records.push_back(record_of(star));
  const std::string_view record_bytes(reinterpret_cast<const char*>(records.data()),
                                      records.size() * sizeof(StarRecord));
  const std::string index = index_of(catalogue.stars, record_bytes);
  const std::string text = text_of(catalogue.text), names = names_of(catalogue.names);
  const StarFileHeader head = header_of(catalogue, index, text, names);
  std::string bytes;
  bytes.reserve(head.file_size);
  bytes.append(bytes_of(head)).append(index).append(text).append(names);
  bytes.resize(head.records_at, '\0');
  bytes += record_bytes;
  write_atomically(file, bytes);
}

}  // namespace domefall
