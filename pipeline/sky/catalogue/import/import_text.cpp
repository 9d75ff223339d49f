#include "pipeline/sky/catalogue/import/import_text.h"

#include <algorithm>
#include <unordered_map>

#include "pipeline/image/map_file.h"

namespace domefall {

float colour_of_b_v(double b_v) { return std::clamp(static_cast<float>(b_v), kBluest, kReddest); }

std::string with_commas(std::size_t count) {
  std::string digits = std::to_string(count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::size_t count, std::string_view what) {
  return with_commas(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

std::size_t first_line_length(const std::filesystem::path& file) {
  const MappedFile mapped(file);
  const std::string_view bytes = mapped.bytes();
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  return line.size() - (line.ends_with('\r') ? 1 : 0);
}

void name_by_hipparcos(std::vector<CatalogueStar>& stars) {
  std::unordered_map<std::uint32_t, CatalogueStar*> brightest;
  for (CatalogueStar& star : stars) {
    if (star.hip == 0) continue;
    CatalogueStar*& best = brightest[star.hip];
    if (!best || star.v < best->v) best = &star;
  }
  for (const auto& [hip, star] : brightest) star->id = hipparcos_id(hip);
}

}  // namespace domefall
