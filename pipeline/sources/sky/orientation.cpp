#include "pipeline/sources/sky/orientation.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace domefall {

M33d galactic_from_equatorial() {
  // Each column is an axis of equatorial coordinates in galactic ones, so that the last components
  // are the north galactic pole, RA 192.86 and Dec 27.13 degrees.
  return from_columns({-0.0548755604, 0.4941094279, -0.8676661490},
                      {-0.8734370902, -0.4448296300, -0.1980763734},
                      {-0.4838350155, 0.7469822445, 0.4559837762});
}

M33d panorama_from_equatorial(const Orientation& o) {
  const double turn = o.centre_deg * std::numbers::pi / 180;
  const double c = std::cos(turn), s = std::sin(turn);
  // Either mirroring flips one axis of the panorama, and both together are a rotation again.
  const double left = o.longitude_right ? -1 : 1, up = o.south_up ? -1 : 1;
  // The rows are the panorama's middle, left quarter and top in the frame's axes.
  const M33d own = from_columns({c, -s * left, 0}, {s, c * left, 0}, {0, 0, up});
  const M33d frame = o.frame == SkyFrame::kGalactic ? galactic_from_equatorial() : M33d();
  return from_columns(apply(own, column(frame, 0)), apply(own, column(frame, 1)),
                      apply(own, column(frame, 2)));
}

std::string orientation_phrase(const Orientation& o) {
  const bool galactic = o.frame == SkyFrame::kGalactic;
  return fmt::format("{}, {} {:g} deg in the middle, growing to the {}, {} up",
                     galactic ? "galactic" : "equatorial", galactic ? "longitude" : "RA",
                     o.centre_deg, o.longitude_right ? "right" : "left",
                     o.south_up ? "south" : "north");
}

}  // namespace domefall
