#include "pipeline/sky/catalogue/star_catalogue.h"

#include <algorithm>

namespace domefall {
namespace {

// Returns Levenshtein's distance.  After i steps row[j] is that of a's first i letters to b's first
// j.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string folded_star_name(std::string_view name) {
  std::string folded;
  for (const char c : name)
    if (c != ' ' && c != '_')
      folded.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return folded;
}

std::optional<SkyDirection> find_star(const StarCatalogue& catalogue, std::string_view name) {
  const std::string wanted = folded_star_name(name);
  for (const NamedStar& star : catalogue.names)
    if (folded_star_name(star.name) == wanted) return star.direction;
  return std::nullopt;
}

std::string nearest_star_name(const StarCatalogue& catalogue, std::string_view name) {
  const std::string wanted = folded_star_name(name);
  std::size_t least = std::max<std::size_t>(2, wanted.size() / 3) + 1;
  std::string nearest;
  for (const NamedStar& star : catalogue.names) {
    const std::size_t distance = edit_distance(folded_star_name(star.name), wanted);
    if (distance >= least) continue;
    least = distance;
    nearest = star.name;
  }
  return nearest;
}

}  // namespace domefall
