// The fuzzer reads star catalogues in .stars files.  Their checksums are made right, so that it
// reaches what they guard.
#include "pipeline/sources/stars/star_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"
#include "pipeline/sources/stars/star_catalogue.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/targets.h"

namespace domefall::fuzz {
namespace {

std::string_view part(std::string_view bytes, std::uint64_t at, std::uint64_t size) {
  return at > bytes.size() ? std::string_view() : bytes.substr(at, size);
}

std::string repaired_stars(std::string bytes) {
  StarFileHeader head;
  if (bytes.size() < sizeof head) return bytes;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::uint64_t blocks = (head.stars + kBlockStars - 1) / kBlockStars;
  for (std::uint64_t k = 0; k < std::min<std::uint64_t>(blocks, 8); ++k) {
    const std::uint64_t at = head.index_at + k * sizeof(StarBlock);
    if (at > bytes.size() || bytes.size() - at < sizeof(StarBlock)) break;
    const std::uint64_t first = k * kBlockStars;
    const auto count = std::min<std::uint64_t>(kBlockStars, head.stars - first);
    const std::uint64_t sum =
        checksum(part(bytes, head.records_at + first * head.record_size, count * head.record_size));
    std::memcpy(bytes.data() + at, &sum, sizeof sum);
  }
  head.index_sum = checksum(part(bytes, head.index_at, blocks * sizeof(StarBlock)));
  head.text_sum = checksum(part(bytes, head.text_at, head.text_size));
  head.names_sum = checksum(part(bytes, head.names_at, head.names_size));
  head.file_size = bytes.size();
  head.head_sum =
      checksum({reinterpret_cast<const char*>(&head), offsetof(StarFileHeader, head_sum)});
  std::memcpy(bytes.data(), &head, sizeof head);
  return bytes;
}

}  // namespace

void star_file(const std::uint8_t* data, std::size_t size) {
  const auto file = input_file(repaired_stars(std::string(text_of(data, size))), "input.stars");
  try {
    const StarCatalogue catalogue =
        read_star_catalogue(file, std::numeric_limits<double>::infinity(), 2100);
    for (const Star& star : catalogue.stars)
      if (!std::isfinite(star.direction.v.x) || !std::isfinite(star.v_magnitude)) std::abort();
  } catch (const InputError&) {
  }
}

}  // namespace domefall::fuzz
