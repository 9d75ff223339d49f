// GradeSettings say how a scene-linear frame becomes one for a projector or a screen.  The show's
// own ASC CDL comes first, then an OpenColorIO display and view.
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace domefall {

// An ASC CDL is applied in ACEScct before the view.  These defaults leave the frame as it is.
struct Cdl {
  std::array<double, 3> slope{1, 1, 1}, offset{0, 0, 0}, power{1, 1, 1};
  double saturation = 1;

  bool operator==(const Cdl&) const = default;
};

// This says what is done about the light that a dome throws upon itself (dome_light.h).
struct DomeSettings {
  enum class Light {
    kNone,
    kSimulate,   // it is added, so that a screen shows the picture as the dome will
    kCompensate  // it is taken away, so that the dome shows the picture as it was made
  };
  Light light = Light::kNone;
  double reflectance = 0.45;  // of the dome's surface, from 0 to 1
};

struct GradeSettings {
  std::filesystem::path config{};  // of OpenColorIO
  bool shipped = false;            // it is Domefall's own, and need not be tried before it is used
  std::string display{};           // empty for the configuration's default
  std::string view{};              // empty for the display's default
  Cdl cdl{};
  DomeSettings dome{};  // for domemasters alone
};

}  // namespace domefall
