#include "pipeline/sky/catalogue/star_catalogue.h"

namespace domefall {
std::string folded_star_name(std::string_view name) {
  std::string folded;
  for (const char c : name)
    if (c != ' ' && c != '_')
      folded.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  return folded;
}

}  // namespace domefall
