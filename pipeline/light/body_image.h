// Finds the images of a body that moves near the hole in regions I and II, each at its retarded
// place.
#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "pipeline/light/place_image.h"
#include "trajectories/directions.h"

namespace domefall {

// A BodyPoint says where a body is at its proper time tau, and how it moves against the rain there,
// or against T near a charge.
// Components are along R, Theta and Phi of the observer's tetrad, which are directions from the
// hole.
struct BodyPoint {
  V3d direction;         // unit
  double r;              // M; 0 stands for a body that is still in region IV
  double null_time;      // v = t + r*, since the instant that the observer's null time counts from
  double gamma, radial;  // of the celerity: its gamma, and its component along R
  V3d angular_momentum;  // r u^phi about its axis, units of M
  double l = 0;          // in a wormhole, whose R points to greater l

  V3d celerity() const { return direction * radial + angular_momentum.cross(direction) / r; }
};

// A BodyMotion gives the points of a body for tau in (begin, end), over which v grows with tau.
struct BodyMotion {
  std::function<BodyPoint(double tau)> at;
  double begin, end;  // may be infinite
  // A tau at which the light is likely to have left, if one is known.  It saves time alone.
  std::optional<double> guess{};
  double least_r = 0, most_r = HUGE_VAL;  // M; between these it stays
};

struct BodyImage {
  V3d direction;           // in the tetrad; unit
  double frequency_ratio;  // observed in the tetrad / emitted
  double r;                // of the body when the light left it, M
  double proper_time;      // its tau then
  double solid_angle_per_area;
  double psi;  // radians that the light swept
  // The following belongs to places about the body, to first order (sphere_image.h).
  V3d across;  // unit: the ray lies in the plane of R and this
  // Light of the plane of R and e instead is emitted with 1/frequency_ratio + swing.(e - across).
  V3d swing;
  double angle_per_length, angle_per_psi;  // PlaceImage's
  V3d ray;  // unit: the direction in which the light left, in the frame that `celerity` is against
  V3d celerity;
  double mino = 0;  // of light near a hole that spins (kerr_event.h)

  // How far the light has come, as discs and gas count it.
  double way() const { return mino > 0 ? mino : psi; }
};

// Returns the image of an order.  Order 0 is the direct image, and odd orders are seen on the other
// side of the hole.  `null_time` is the observer's v (rain) or u (outgoing frame).  `radius` is the
// body's (M, >= 0), which bounds its light on the axis of the lens.  Nothing is returned where no
// light of that order gets to the observer.  From outside, what falls into the hole is seen to come
// to rest above the horizon, ever redder.  Whoever falls after it sees it cross the horizon when
// crossing it, and then within.  The time of emission is right to 1e-10 of r.
std::optional<BodyImage> image_of_body(const PlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius);
// The same near a charge, where rain is the tetrad T.
std::optional<BodyImage> image_of_body(const ChargedPlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius);
// The same in a wormhole, on either side of it, where rain is at rest and v = t + l.
std::optional<BodyImage> image_of_body(const WormholePlaceView& view, double null_time,
                                       const BodyMotion& motion, int order, double radius);

// A SeenPlace is a place of region I whose light is seen by an observer at an instant.
struct SeenPlace {
  PlaceLight light;
  double from_hole;  // the direction's angle from the hole, radians
  double null_time;  // v at which that light left
  // Its frequency in the frame of BodyPoint::gamma, where it is one in the tetrad, and the component
  // of its motion along R, times that frequency.
  double frequency, along_r;
};

// Returns the light of a place at psi >= 0, as image_of_body does.  Nothing is returned where none
// gets to the observer.
std::optional<SeenPlace> seen_place(const PlaceView& view, double null_time, double r, double psi);
std::optional<SeenPlace> seen_place(const ChargedPlaceView& view, double null_time, double r,
                                    double psi);

}  // namespace domefall
