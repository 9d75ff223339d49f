#include "pipeline/sky/catalogue/star_id.h"

#include <charconv>
#include <vector>

namespace domefall {
namespace {

enum Kind : std::uint32_t { kNone = 0, kHip = 1, kHd = 2, kTycho = 3 };

constexpr int kKindBit = 30, kRegionBit = 16, kNumberBit = 2;
constexpr StarId kLargest = (1u << kKindBit) - 1;
constexpr std::uint32_t kRegions = 9537, kNumbers = 12121, kComponents = 4;

constexpr StarId of_kind(Kind kind, std::uint32_t number) { return (kind << kKindBit) | number; }

// Whole numbers between dashes; empty if there is anything else.
std::vector<std::uint32_t> numbers_of(std::string_view text) {
  std::vector<std::uint32_t> numbers;
  for (;;) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value == 0 || value > kLargest) return {};
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return numbers;
    if (text[0] != '-') return {};
    text.remove_prefix(1);
  }
}

}  // namespace

StarId hipparcos_id(std::uint32_t number) { return of_kind(kHip, number); }
StarId henry_draper_id(std::uint32_t number) { return of_kind(kHd, number); }
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component) {
  return of_kind(kTycho, region << kRegionBit | number << kNumberBit | (component - 1));
}

std::string star_id_name(StarId id) {
  const StarId number = id & kLargest;
  switch (id >> kKindBit) {
    case kHip:
      return "HIP " + std::to_string(number);
    case kHd:
      return "HD " + std::to_string(number);
    case kTycho:
      return "TYC " + std::to_string(number >> kRegionBit) + "-" +
             std::to_string((number >> kNumberBit) & ((1u << (kRegionBit - kNumberBit)) - 1)) +
             "-" + std::to_string((number & (kComponents - 1)) + 1);
    default:
      return "";
  }
}

std::optional<StarId> parse_star_id(std::string_view text) {
  std::string folded;
  for (const char c : text)
    if (c != ' ') folded.push_back(static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c));
  for (const auto& [prefix, kind] :
       {std::pair<std::string_view, Kind>{"HIP", kHip}, {"HD", kHd}, {"TYC", kTycho}}) {
    if (!folded.starts_with(prefix)) continue;
    const auto numbers = numbers_of(std::string_view(folded).substr(prefix.size()));
    if (kind != kTycho && numbers.size() == 1) return of_kind(kind, numbers[0]);
    if (kind == kTycho && numbers.size() == 3 && numbers[0] <= kRegions && numbers[1] <= kNumbers &&
        numbers[2] <= kComponents)
      return tycho_id(numbers[0], numbers[1], numbers[2]);
  }
  return std::nullopt;
}

}  // namespace domefall
