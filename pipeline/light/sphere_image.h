// The image of a glowing sphere near the hole is drawn in pieces.
//
// Whoever looks at a sphere sees a disc of its radius, at right angles to the light, however the
// sphere moves (Penrose 1959, Terrell 1959).  A plane through the axis of hole and observer cuts a
// chord out of this disc, and the image of the chord lies in the same plane, at the angles from the
// hole that follow from PlaceImage to first order.  So the image is an ellipse, an arc where the
// sphere is next to the axis, and a ring where the axis goes through it.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "pipeline/light/body_image.h"
#include "pipeline/light/sky_points.h"

namespace domefall {

// Returns the longer of the sizes of the image along and across its plane, in radians.
double size_of_sphere(const BodyImage& image, double radius);

// A RingCrossing is where light from a sphere goes through one of its rings.
struct RingCrossing {
  int ring = -1;         // none
  double steepness = 1;  // cosine of the angle between the light and the ring's axis
};

// A SpherePiece is a piece of the image, which has its solid angle in the tetrad in place of the
// amplification, and its own frequency ratio.
struct SpherePiece {
  SkyImage at;
  double cosine;  // of the angle at which its light left the surface
  V3d place;      // on the sphere: unit, along the axes of the tetrad, in the body's own frame
  double width =
      0;  // of what is seen of the sphere within the spacing, where it is widest, in radii
  RingCrossing through{};
};

// A RingPlane has the rings of a sphere, from the inmost one on.
struct RingPlane {
  V3d normal{0, 0, 1};                           // unit, along the axes of the tetrad
  std::vector<std::pair<double, double>> edges;  // of each ring, in radii of the sphere

  // Returns which of them a place has, in radii, or -1.
  int ring_at(const V3d& place) const {
    const double radius = place.length();
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (radius > edges[k].first && radius < edges[k].second) return static_cast<int>(k);
    return -1;
  }
};

// A RingPiece is a piece of a ring's image, like a SpherePiece.
struct RingPiece {
  SkyImage at;
  int ring;
  V3d place, leaving;  // in radii; unit, the direction of its light in the body's frame
  double width;        // SpherePiece's
};

// A RingedSphere is the image of a sphere with rings, each without what the other hides, as light goes
// straight next to the body.
struct RingedSphere {
  std::vector<SpherePiece> sphere;
  std::vector<RingPiece> rings;
};

// Returns the direction in which light left the body, in its own frame, that came in the plane of R
// and e.
V3d leaving_in(const BodyImage& image, const V3d& e);

// Returns the integral of |sin x| up to x, between -pi and 2 pi.
double area_up_to(double x);

// Returns the image of one order of a sphere of this radius (M, > 0).  There are at
// most 4096 chords, and 4096 pieces of one.  Otherwise pieces are no longer than spacing(direction)
// in the middle of the image and of the chord.  The two orders that meet in a ring have half of it
// each.  To first order, angles err by a part of about the radius over the distance to the observer
// or to the hole, whichever is nearer.
std::vector<SpherePiece> image_of_sphere(const BodyImage& image, double radius,
                                         const std::function<double(const V3d&)>& spacing);

}  // namespace domefall
