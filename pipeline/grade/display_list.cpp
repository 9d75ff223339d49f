#include "pipeline/grade/display_list.h"

#include "pipeline/grade/view_transform.h"

namespace domefall {

std::vector<DisplayViews> displays_of(const std::filesystem::path& config) {
  const auto read = read_config(config.string());
  std::vector<DisplayViews> displays;
  for (int k = 0; k < read->getNumDisplays(); ++k) {
    const char* display = read->getDisplay(k);
    displays.push_back({display, {}});
    for (int v = 0; v < read->getNumViews(display); ++v)
      displays.back().views.emplace_back(read->getView(display, v));
  }
  return displays;
}

}  // namespace domefall
