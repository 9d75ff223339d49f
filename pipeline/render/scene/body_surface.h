// The surface of a sphere: how much light each place of it sends to the observer, and of what colour.
#pragma once

#include <memory>
#include <optional>

#include "pipeline/light/sphere_image.h"
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

  // Says whether all places shine alike.
  bool is_even() const { return !map_ && !body_.lit_from; }
  // Returns the light of a place, over the mean of the disc of a sphere that shines, or that is lit
  // from behind the observer.
  double light(const SpherePiece& piece) const;
  // Returns the colour of the texture there.  Over the whole sphere its luminance is 1.
  WorkingRgb tint(const SpherePiece& piece) const;

 private:
  const Body& body_;
  const BodyImage& image_;
  const ObserverState& observer_;
  V3d place_;                // of the body, M
  std::optional<V3d> lamp_;  // the place of what lights it, M
  std::optional<V3d> from_;  // the direction of light from the sky
  std::shared_ptr<const SkyMap> map_;
  double mean_ = 1;  // luminance of the map
};

}  // namespace domefall
