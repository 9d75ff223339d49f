// This file lists the displays of an OpenColorIO configuration, and the views of each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace domefall {

struct DisplayViews {
  std::string display;
  std::vector<std::string> views;
};

// Returns the active displays in the order of the configuration.  Throws InputError if the file is
// no configuration.
std::vector<DisplayViews> displays_of(const std::filesystem::path& config);

}  // namespace domefall
