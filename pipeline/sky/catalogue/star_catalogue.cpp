#include "pipeline/sky/catalogue/star_catalogue.h"

#include <algorithm>
#include <cmath>

namespace domefall {

std::vector<Star> thinned(const std::vector<Star>& stars, std::size_t whole) {
  std::vector<Star> kept(
      stars.begin(), stars.begin() + static_cast<std::ptrdiff_t>(std::min(whole, stars.size())));
  std::size_t step = 2;
  // Stars from `first` to twice `first` stand for `step` stars each, which is 2.5 log10(step) in
  // magnitude.  The kept star is the middle one of its step.
  for (std::size_t first = whole; first < stars.size(); first *= 2, step *= 2) {
    const std::size_t end = std::min(2 * first, stars.size());
    for (std::size_t k = first + step / 2; k < end; k += step) {
      kept.push_back(stars[k]);
      kept.back().v_magnitude -= static_cast<float>(2.5 * std::log10(static_cast<double>(step)));
    }
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Star& a, const Star& b) { return a.v_magnitude < b.v_magnitude; });
  return kept;
}

std::string folded_star_name(std::string_view name) {
  std::string folded;
  for (const char c : name)
    if (c != ' ' && c != '_')
      folded.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return folded;
}

}  // namespace domefall
