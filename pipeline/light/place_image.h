// The image of a place near the hole is the ray that passes r after having swept psi.  There is one
// for each psi.  For at a fixed psi r grows with the ray's angle from the hole throughout, across
// the silhouette's edge too.
#pragma once

#include <optional>

#include "pipeline/light/null_ray.h"
#include "pipeline/spacetime/charged.h"
#include "pipeline/spacetime/wormhole.h"

namespace domefall {

// A PlaceView says from where places are seen, by an observer in free fall.  `far` looks from
// region II into region III (rain, r < 2), and otherwise the view is into region I.
struct PlaceView {
  Radius at;
  bool outgoing = false;
  bool far = false;
};

// The same near a charge, by an observer in the tetrad T above the inner horizon.
struct ChargedPlaceView {
  ChargedHole hole;
  double r;  // M
  bool far = false;
};

// The same in a wormhole, for an observer at rest.
struct WormholePlaceView {
  Wormhole wormhole;
  double l;
};

// A PlaceLight is the light of the place.
struct PlaceLight {
  double sin_half = 0, cos_half = 1;  // of alpha/2, alpha from -R or, in the outgoing frame, from R
  double energy = 0, angular_momentum = 0;  // E, signed, and L of light that is one in the tetrad
  double slope = 0;                         // dr/dpsi, signed; dl/dpsi in a wormhole
  double null_time = 0;                     // ray_times.h
  // This is the solid angle at the observer per area at right angles to the light at the place,
  // which is the same for whoever moves there, in units of M^-2.  It is |E|/(r_o |sin psi
  // dr/dalpha|), where r_o is the observer's r.  Where a point on the axis would be a ring, which
  // holds for all images but the direct one of a point in front, |sin psi| counts as `blur` at
  // least.
  double solid_angle_per_area = 0;
  // For places nearby, these are the angle in the image per length at right angles to the light
  // within the ray's plane, in radians per M, and how the angle from the hole grows with psi at the
  // same r.
  double angle_per_length = 0, angle_per_psi = 0;
};

struct PlaceImage : PlaceLight {
  NullRay ray;
};

// Returns the image of a place at 2 < r < infinity and psi >= 0 radians from the observer's radial
// direction, in the sense of the ray.  The n-th image has the n-th of psi, 2 pi - psi, 2 pi + psi
// and so on.  Nothing is returned where no ray gets there: in region IV, and from region II to
// places below r = 3 beyond some turns.  `blur` is in radians, >= 0.  Measured, the ray comes back
// to the place within 1e-12 of r beside what 1e-15 in psi makes of it.  The solid angle is within
// 1e-7 of that between rays to places nearby.
std::optional<PlaceImage> image_of_place(const PlaceView& view, double r, double psi, double blur);

// The same near a charge, for places outside, and for those between the horizons from where light
// falls to an observer there.  Measured, the place is right to 1e-12 e^psi, the time to 1e-11
// (1 + |v|) e^psi, and the solid angle to 1e-6.
std::optional<PlaceLight> image_of_place(const ChargedPlaceView& view, double r, double psi,
                                         double blur);

// The same in a wormhole, for a place at l on either side, where l is what grows with the angle from
// -R at the same psi.  Measured against rays of 6,000 small steps, l and psi agree to 1e-9 e^psi, and
// the solid angle to 1e-3, within what the steps err.
std::optional<PlaceLight> image_of_place(const WormholePlaceView& view, double l, double psi,
                                         double blur);

}  // namespace domefall
