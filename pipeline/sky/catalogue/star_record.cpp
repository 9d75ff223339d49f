#include "pipeline/sky/catalogue/star_record.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace domefall {
namespace {

constexpr double kRadiansPerMas = std::numbers::pi / 180 / 3.6e6;
constexpr std::uint32_t kGone = static_cast<std::uint32_t>(-1);

// Names follow their stars to the places that `place_of` gives them.
void move_names(std::vector<StarName>& names, const std::vector<std::uint32_t>& place_of) {
  for (StarName& name : names) name.star = place_of[name.star];
  std::erase_if(names, [](const StarName& name) { return name.star == kGone; });
  std::stable_sort(names.begin(), names.end(),
                   [](const StarName& a, const StarName& b) { return a.star < b.star; });
}

}  // namespace

SkyDirection moved(const SkyDirection& from, double pm_ra, double pm_dec, double years) {
  const V3d& p = from.v;
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const double c = rho > 0 ? p.x / rho : 1, s = rho > 0 ? p.y / rho : 0;
  const double east = pm_ra * years * kRadiansPerMas, north = pm_dec * years * kRadiansPerMas;
  const V3d q(p.x - east * s - north * p.z * c, p.y + east * c - north * p.z * s,
              p.z + north * rho);
  return {q / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z)};
}

void sort_by_brightness(RawCatalogue& catalogue) {
  const std::size_t count = catalogue.stars.size();
  // Sorting pairs of magnitude and place is three times as fast as sorting the stars.
  std::vector<std::pair<float, std::uint32_t>> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = {catalogue.stars[i].v, i};
  std::sort(order.begin(), order.end());
  std::vector<CatalogueStar> sorted;
  sorted.reserve(count);
  std::vector<std::uint32_t> place_of(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sorted.push_back(catalogue.stars[order[i].second]);
    place_of[order[i].second] = i;
  }
  catalogue.stars = std::move(sorted);
  move_names(catalogue.names, place_of);
}

void keep_brighter(RawCatalogue& catalogue, double faintest) {
  const auto limit = static_cast<float>(faintest);
  std::vector<std::uint32_t> place_of(catalogue.stars.size(), kGone);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < catalogue.stars.size(); ++i)
    if (catalogue.stars[i].v <= limit) {
      place_of[i] = kept;
      catalogue.stars[kept++] = catalogue.stars[i];
    }
  catalogue.stars.resize(kept);
  move_names(catalogue.names, place_of);
}

}  // namespace domefall
