// The images of a body that moves near the hole in region I, each at its retarded place.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/optics/place_image.h"
#include "trajectories/directions.h"

namespace domefall {

// Where a body is at the time t, by components along R, Theta and Phi of the observer's tetrad as
// directions from the hole, and how it moves, by what its four-velocity u conserves on a geodesic.
struct BodyPoint {
  V3d direction;         // unit
  double r;              // > 2 (M)
  double energy;         // (1 - 2/r) u^t
  double radial;         // u^r
  V3d angular_momentum;  // r^2 u^phi about its axis
};
// t counts as the null coordinates do of which it is made: v - r* in rain, u + r* in the outgoing
// frame (emission_time.h).
using BodyMotion = std::function<BodyPoint(double t)>;

struct BodyImage {
  V3d direction;           // in the tetrad; unit
  double frequency_ratio;  // observed in the tetrad / emitted
  double r;                // of the body when the light left it, M
  double t;                // then
  double solid_angle_per_area;
  double psi;  // radians that the light swept
};

// The image of an order, 0 the direct one: odd ones are seen on the other side of the hole.
// `null_time` is the observer's v or u, `radius` the body's (M, >= 0), which bounds its light on
// the axis of the lens.  None where no light of that order gets to the observer.  The time of
// emission is right to 1e-10 of r.
std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius);

}  // namespace domefall
