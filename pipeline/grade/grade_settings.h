// What turns a scene-linear frame into one for a projector or screen: an OpenColorIO display and
// view, after the show's own ASC CDL.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace domefall {

struct GradeSettings {
  std::filesystem::path config;  // OpenColorIO's; read_show puts in the shipped one
  std::string display;           // empty: the configuration's default
  std::string view;              // empty: the display's default
  // ASC CDL, applied in ACEScct before the view; these defaults leave the frame as it is.
  std::array<double, 3> slope{1, 1, 1}, offset{0, 0, 0}, power{1, 1, 1};
  double saturation = 1;
};

}  // namespace domefall
