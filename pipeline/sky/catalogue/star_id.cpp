#include "pipeline/sky/catalogue/star_id.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

namespace domefall {
namespace {

enum class Kind : std::uint32_t { kHip = 1, kHd = 2, kTycho = 3 };  // 0: none

// The kind, and the region and number of a Tycho star, begin at these of the 32 bits.  The two
// lowest bits of a Tycho star hold its component less 1.  Regions and numbers are below 2^14, so
// that a Tycho star just fills the 30 bits below the kind.
constexpr int kKindBit = 30, kRegionBit = 16, kNumberBit = 2;
constexpr StarId kLargestNumber = (1u << kKindBit) - 1;
constexpr std::uint32_t kRegions = 9537, kNumbersInRegion = 12121, kComponents = 4;

// Returns the identifier of a number, which must be below 2^30.
constexpr StarId of_kind(Kind kind, std::uint32_t number) {
  return (static_cast<std::uint32_t>(kind) << kKindBit) | number;
}

// Returns the numbers of a text such as "5949-2777-1", or none if the text has any other form.
std::vector<std::uint32_t> numbers_of(std::string_view text) {
  std::vector<std::uint32_t> numbers;
  for (;;) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // No catalogue numbers a star or a component 0.
    if (error != std::errc() || value == 0 || value > kLargestNumber) return {};
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return numbers;
    if (text[0] != '-') return {};
    text.remove_prefix(1);
  }
}

}  // namespace

StarId hipparcos_id(std::uint32_t number) { return of_kind(Kind::kHip, number); }
StarId henry_draper_id(std::uint32_t number) { return of_kind(Kind::kHd, number); }
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component) {
  return of_kind(Kind::kTycho, region << kRegionBit | number << kNumberBit | (component - 1));
}

std::string star_id_name(StarId id) {
  const StarId number = id & kLargestNumber;
  switch (Kind(id >> kKindBit)) {
    case Kind::kHip:
      return fmt::format("HIP {}", number);
    case Kind::kHd:
      return fmt::format("HD {}", number);
    case Kind::kTycho:
      return fmt::format("TYC {}-{}-{}", number >> kRegionBit,
                         (number >> kNumberBit) & ((1u << (kRegionBit - kNumberBit)) - 1),
                         (number & (kComponents - 1)) + 1);
    default:
      return "";
  }
}

std::optional<StarId> parse_star_id(std::string_view text) {
  // Letters count as capitals, and blanks are dropped.
  std::string folded;
  for (const char c : text)
    if (c != ' ') folded.push_back(static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c));
  for (const auto& [prefix, kind] : {std::pair<std::string_view, Kind>{"HIP", Kind::kHip},
                                     {"HD", Kind::kHd},
                                     {"TYC", Kind::kTycho}}) {
    if (!folded.starts_with(prefix)) continue;
    const auto numbers = numbers_of(std::string_view(folded).substr(prefix.size()));
    if (kind != Kind::kTycho && numbers.size() == 1) return of_kind(kind, numbers[0]);
    if (kind == Kind::kTycho && numbers.size() == 3 && numbers[0] <= kRegions &&
        numbers[1] <= kNumbersInRegion && numbers[2] <= kComponents)
      return tycho_id(numbers[0], numbers[1], numbers[2]);
  }
  return std::nullopt;
}

}  // namespace domefall
