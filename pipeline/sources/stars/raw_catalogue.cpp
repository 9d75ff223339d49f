#include "pipeline/sources/stars/raw_catalogue.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <unordered_map>
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

constexpr std::uint32_t kGone = static_cast<std::uint32_t>(-1);

// Gives the names the new indices of their stars, and removes those whose star is gone.
void move_names(std::vector<StarName>& names, const std::vector<std::uint32_t>& index_of) {
  for (StarName& name : names) name.star = index_of[name.star];
  std::erase_if(names, [](const StarName& name) { return name.star == kGone; });
  std::ranges::stable_sort(names, {}, &StarName::star);
}

}  // namespace

StarId hipparcos_id(std::uint32_t number) { return of_kind(Kind::kHip, number); }
StarId henry_draper_id(std::uint32_t number) { return of_kind(Kind::kHd, number); }
StarId tycho_id(std::uint32_t region, std::uint32_t number, std::uint32_t component) {
  return of_kind(Kind::kTycho, region << kRegionBit | number << kNumberBit | (component - 1));
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

void sort_by_brightness(RawCatalogue& catalogue) {
  const std::size_t count = catalogue.stars.size();
  // Sorting pairs of magnitude and index is three times as fast as sorting the stars.
  std::vector<std::pair<float, std::uint32_t>> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = {catalogue.stars[i].v, i};
  std::ranges::sort(order);
  std::vector<CatalogueStar> sorted;
  sorted.reserve(count);
  std::vector<std::uint32_t> index_of(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sorted.push_back(catalogue.stars[order[i].second]);
    index_of[order[i].second] = i;
  }
  catalogue.stars = std::move(sorted);
  move_names(catalogue.names, index_of);
}

void keep_brighter(RawCatalogue& catalogue, double faintest) {
  // V is a float, and the limit is rounded to one, so that a star exactly at the limit stays.
  const auto limit = static_cast<float>(faintest);
  std::vector<std::uint32_t> index_of(catalogue.stars.size(), kGone);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < catalogue.stars.size(); ++i)
    if (catalogue.stars[i].v <= limit) {
      index_of[i] = kept;
      catalogue.stars[kept++] = catalogue.stars[i];
    }
  catalogue.stars.resize(kept);
  move_names(catalogue.names, index_of);
}

void identify_by_hipparcos(std::vector<CatalogueStar>& stars) {
  std::unordered_map<std::uint32_t, CatalogueStar*> brightest;
  for (CatalogueStar& star : stars) {
    if (star.hip == 0) continue;
    CatalogueStar*& best = brightest[star.hip];
    // Of stars that are equally bright the first one wins.
    if (!best || star.v < best->v) best = &star;
  }
  // Each entry changes a star of its own, so that the order of the map does not matter.
  for (const auto& [hip, star] : brightest) star->id = hipparcos_id(hip);
}

// With rho = cos Dec, the unit vectors at p are east = (-sin RA, cos RA, 0) and north = (-sin Dec
// cos RA, -sin Dec sin RA, cos Dec).  In the code c = cos RA, s = sin RA and p.z = sin Dec.
SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years) {
  constexpr double kRadiansPerMas = std::numbers::pi / 180 / 3.6e6;
  const V3d& p = from.v;
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const double c = rho > 0 ? p.x / rho : 1, s = rho > 0 ? p.y / rho : 0;
  const double east = pm_ra * years * kRadiansPerMas, north = pm_dec * years * kRadiansPerMas;
  const V3d q(p.x - east * s - north * p.z * c, p.y + east * c - north * p.z * s,
              p.z + north * rho);
  return {q / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)};
}

}  // namespace domefall
