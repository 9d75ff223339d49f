// The displays of an OpenColorIO configuration, and the views of each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

struct DisplayViews {
  std::string display;
  std::vector<std::string> views;
};

// In the order of the configuration, the active ones.  Throws InputError if the file is none.
std::vector<DisplayViews> displays_of(const std::filesystem::path& config);

}  // namespace domefall
