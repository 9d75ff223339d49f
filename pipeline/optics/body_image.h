// The images of a body that moves near the hole in regions I and II, each at its retarded place.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/optics/place_image.h"
#include "trajectories/directions.h"

namespace domefall {

// Where a body is at its proper time tau, by components along R, Theta and Phi of the observer's
// tetrad as directions from the hole, and how it moves against the rain there.
struct BodyPoint {
  V3d direction;         // unit
  double r;              // M; 0 stands for a body that is not there yet: in region IV
  double null_time;      // v = t + r*, since the instant that the observer's null time counts from
  double gamma, radial;  // of the celerity: its gamma, and its component along R
  V3d angular_momentum;  // r u^phi about its axis, units of M
};

// tau in (begin, end); v grows with tau.
struct BodyMotion {
  std::function<BodyPoint(double tau)> at;
  double begin, end;  // may be infinite
};

struct BodyImage {
  V3d direction;           // in the tetrad; unit
  double frequency_ratio;  // observed in the tetrad / emitted
  double r;                // of the body when the light left it, M
  double proper_time;      // its tau then
  double solid_angle_per_area;
  double psi;  // radians that the light swept
  // What belongs to places about the body, to first order (sphere_image.h).
  V3d across;  // unit: the ray lies in the plane of R and this
  V3d swing;   // light of the plane of R and e instead is emitted with the frequency
               // 1/frequency_ratio + swing.(e - across)
  double angle_per_length, angle_per_psi;  // PlaceImage's
};

// The image of an order, 0 the direct one: odd ones are seen on the other side of the hole.
// `null_time` is the observer's v (rain) or u (outgoing frame), `radius` the body's (M, >= 0),
// which bounds its light on the axis of the lens.  None where no light of that order gets to the
// observer. What falls into the hole is seen from outside to come to rest above the horizon, for
// ever redder; who falls after it sees it cross the horizon when crossing it, and then within.
// The time of emission is right to 1e-10 of r.
std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius);

}  // namespace domefall
