#include "pipeline/sky/catalogue/raw_catalogue.h"

#include <algorithm>
#include <unordered_map>

namespace domefall {
namespace {

// This stands for the index of a star that was removed.
constexpr std::uint32_t kGone = static_cast<std::uint32_t>(-1);

// Gives the names the new indices of their stars, and removes those whose star is gone.
void move_names(std::vector<StarName>& names, const std::vector<std::uint32_t>& index_of) {
  for (StarName& name : names) name.star = index_of[name.star];
  std::erase_if(names, [](const StarName& name) { return name.star == kGone; });
  std::stable_sort(names.begin(), names.end(),
                   [](const StarName& a, const StarName& b) { return a.star < b.star; });
}

}  // namespace

void sort_by_brightness(RawCatalogue& catalogue) {
  const std::size_t count = catalogue.stars.size();
  // Sorting pairs of magnitude and index is three times as fast as sorting the stars.
  std::vector<std::pair<float, std::uint32_t>> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = {catalogue.stars[i].v, i};
  // Stars of one magnitude are ordered by their index, which keeps their order.
  std::sort(order.begin(), order.end());
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

}  // namespace domefall
