// How rays near a spinning hole pass a body that moves.
#pragma once

#include <optional>

#include "pipeline/light/body_image.h"
#include "pipeline/light/kerr_event.h"

namespace domefall {

// What a body is at one proper time, in the coordinates of the events of a ray.
struct KerrBodyPoint {
  KerrSpot at;
  double null_time;  // v, counted as the observer's
  TetradVector velocity;
};

// A KerrPass is what a ray is to a body, as that sees it when the light leaves.
struct KerrPass {
  V3d view;  // unit, in the observer's tetrad
  double mino, tau;
  KerrEvent event;
  KerrBodyPoint body;
  double frequency;  // that the body gives to light that is one in the observer's tetrad
  V3d leaving;       // unit, the way of the light in the body's frame
  V3d off;           // from the ray to the body, at right angles to the light, M
  // By how much the ray moves there if one looks at a greater delta, or across that.
  V3d by_delta, across;
  // What is still to be added to tau, and to the Mino time, if the view stays.
  double late, ahead;
  double ahead_by_delta, ahead_across;  // to the Mino time if the view turns
};

class KerrBodyRays {
 public:
  // The motion must outlive this object.  `null_time` is the observer's.
  KerrBodyRays(const KerrPlace& at, double null_time, const BodyMotion& motion);

  // The body at a proper time, in (begin, end) of its motion, or nothing where it is none of regions I
  // and II.
  std::optional<KerrBodyPoint> body(double tau) const;

  // The ray of one direction at a Mino time, and the body at a time of its own.  They are to be near
  // each other.
  std::optional<KerrPass> pass(const V3d& view, double mino, double tau) const;
  // Moves on along the ray to where it is nearest to the body, as that sees it.
  std::optional<KerrPass> nearest(const V3d& view, double mino, double tau) const;
  // Finds the ray that meets the body, by Newton's method from one nearby.
  std::optional<KerrPass> meet(const V3d& view, double mino, double tau) const;

  const KerrPlace& at() const { return at_; }
  double null_time() const { return null_time_; }
  const BodyMotion& motion() const { return motion_; }
  // The axes of the tetrad as directions like KerrSpot::place.
  const M33d& axes() const { return axes_; }

 private:
  KerrPlace at_;
  double null_time_;
  const BodyMotion& motion_;
  M33d axes_;
};

// A Turn is a step of the view, by delta and across that (radians).
struct Turn {
  double by_delta, across;
};
// Returns the view after a part of a turn.  Rays that wind up change by factors as they come nearer to
// the silhouette's edge, and so are turned along it and, by a part of their distance, away from it.
V3d turned_view(const KerrPass& pass, const KerrPlace& at, const Turn& turn, double part);

// A KerrStretch is by how much a ray moves at the body for each angle of view, by its singular values.
struct KerrStretch {
  double longer, shorter;         // M
  V3d along, across;              // unit, in the body's frame: in which the views `longer_view` and
  V3d longer_view, shorter_view;  // unit, in the tetrad: move it by these
};
KerrStretch kerr_stretch(const KerrPass& pass);

}  // namespace domefall
