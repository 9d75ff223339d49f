// A LightPath is the way of one ray past places near the hole, followed back in time from the
// observer, for matter that glows all along it.
//
// With w = 1/r and the swept angle psi, light obeys w'' = -w + 3 w^2 - 2 q^2 w^3 near a hole of charge
// q (M = 1), and w'' = -w if it goes straight.  This is integrated in steps of fourth order, which
// are short where r changes fast.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/light/plane_images.h"

namespace domefall {

// A GasView is from where one observer sees what is all around the hole.
struct GasView {
  PlaneView view;
  // The angle alpha of light_path() at which light winds around the hole, if light is bent.
  std::optional<double> edge;
};

struct LightPath {
  // E and L of light that is one in the frame of the view.  E > 0: light of region I.
  double energy = 0, momentum = 0;
  struct Place {
    double psi, w, slope;  // radians, 1/M, dw/dpsi
    double cosine, sine;   // of psi
    // v of the place less that of the observer, M; u in the outgoing frame.  Straight light has 0.
    double time;
  };
  // From the observer on, as far as the path lies between the radii.  A place in the hole is where
  // the path of an observer in region II begins.
  std::vector<Place> places;

  // Returns 1/r between two successive places, by the cubic through them; `part` is 0 to 1.
  static double inverse_radius(const Place& a, const Place& b, double part) {
    const double h = b.psi - a.psi, t = part, s = 1 - part;
    return s * s * ((1 + 2 * t) * a.w + t * h * a.slope) +
           t * t * ((1 + 2 * s) * b.w - s * h * b.slope);
  }
};

// Finds the path of the ray at 0 < alpha < pi (radians) from -R, or from R in an outgoing frame,
// down to the horizon and up to r = `outer`, and no farther than 7/2 half turns.  It has no places
// where no light of region I comes that way, and none where it only leads away from the radii.
// Measured against RayOrbits at r from 0.5 to 100, w is within 1e-5 e^psi, and the time within 0.05 M.
LightPath light_path(const PlaneView& view, double alpha, double outer);

}  // namespace domefall
