#include "pipeline/sky/catalogue/star_catalogue.h"

#include <algorithm>
#include <cmath>

namespace domefall {

Star standing_for(Star star, std::size_t count) {
  // A factor in flux is -2.5 log10 of it in magnitudes, by Pogson's scale.
  star.v_magnitude -= static_cast<float>(2.5 * std::log10(static_cast<double>(count)));
  return star;
}

void sort_by_magnitude(std::vector<Star>& stars) {
  // Catalogues are sorted as a rule, so that the test saves time.
  if (!std::ranges::is_sorted(stars, {}, &Star::v_magnitude))
    std::ranges::stable_sort(stars, {}, &Star::v_magnitude);
}

std::string folded_star_name(std::string_view name) {
  std::string folded;
  for (const char c : name)
    if (c != ' ' && c != '_')
      folded.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return folded;
}

}  // namespace domefall
