// The surface of a sphere and its rings: how much light each place of them sends to the observer, and
// of what colour.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/light/sphere_surface.h"
#include "pipeline/show/body.h"
#include "pipeline/sources/colour/colour_space.h"
#include "pipeline/sources/sky/sky_map.h"
#include "trajectories/observer_state.h"

namespace domefall {

class BodySurface {
 public:
  // As the body is seen in an image.  All three must outlive this object.  Throws InputError for a
  // texture that cannot be read.
  BodySurface(const Body& body, const BodyImage& image, const ObserverState& observer);

  // Says whether all places shine alike, but for granules, whose mean a small sphere has.
  bool is_even() const { return !map_ && !body_.lit_from && body_.rings.empty(); }
  // Returns the light of a place, over the mean of the disc of a sphere that shines, or that is lit
  // from behind the observer.
  double light(const SpherePiece& piece) const;
  // The same of a ring.  Its particles are spheres, each lit as the body is and twice as bright, or lit
  // by a body that shines itself.
  double light(const RingPiece& piece) const;
  // Returns the part of the light from behind that a ring leaves.
  double left_by(const RingCrossing& crossing) const;
  double left_by(const RingPiece& piece) const;
  // The plane and the edges of the rings in the tetrad.
  const RingPlane& rings() const { return rings_; }

  // Returns the colour of the texture there.  Over the whole sphere its luminance is 1.
  WorkingRgb tint(const SpherePiece& piece) const;

 private:
  V3d own_place(const V3d& place) const;
  // Returns the direction to what lights a place (radii), or nothing where nothing does.
  std::optional<V3d> to_lamp(const V3d& place) const;
  double left_in_shadow(const SpherePiece& piece, const V3d& to_lamp) const;

  const Body& body_;
  const BodyImage& image_;
  const ObserverState& observer_;
  M33d axes_;
  V3d place_;                // of the body, M
  std::optional<V3d> lamp_;  // the place of what lights it, M
  std::optional<V3d> from_;  // the direction of light from the sky
  std::shared_ptr<const SkyMap> map_;
  double mean_ = 1;  // luminance of the map
  RingPlane rings_;
};

}  // namespace domefall
