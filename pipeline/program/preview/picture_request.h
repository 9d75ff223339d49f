// A PictureRequest is what a client of the live preview asks to see.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/show/overlay_kind.h"
#include "pipeline/show/show.h"

namespace domefall {

// A ScreenLook says where a screen's camera looks, for the audience of the frame.  The angles are
// degrees to the right of their front, above their horizon, and clockwise about the line of sight.
struct ScreenLook {
  double azimuth_deg = 0, altitude_deg = 45, roll_deg = 0;
};

struct PictureRequest {
  int frame = 0;
  Projection projection;
  std::optional<ScreenLook> look;  // nothing: the show's own camera
  double ev = 0;                   // stops that are added to the show's
  std::string display, view;       // empty: the show's
  std::optional<Effects> effects;  // nothing: the show's
  PerSky<bool> skies;              // those that are not left black
  bool stars = true;
  std::vector<OverlayKind> overlays;
  bool moving = false;  // whether a picture that is less fine but sooner there is better
};

// Parameters give the value of a parameter of the request's address, or nothing where it is not
// given.
using Parameters = std::function<std::optional<std::string>(std::string_view name)>;

// The width and the height of a picture are between these numbers of pixels.
inline constexpr int kLeastSide = 16, kMostSide = 4096;

// Reads what the address says.  A frame beyond the show's end becomes its last one, since a show
// may have been cut while its page was open.  Throws InputError naming the parameter and what it
// may be.
PictureRequest read_request(const Parameters& parameters, const Show& show);

}  // namespace domefall
