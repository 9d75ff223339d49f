// The optics of a wormhole, for an observer at rest in it.
//
// The view has two zones.  In each a sky is seen as a whole, infinitely often towards the edge that
// they share: the sky of the other side within the circle of the throat, and that of the observer's
// own side around it.  Angles alpha count from the direction towards the throat, which is -R for
// l >= 0 and R for l < 0.  The angles of a place are common to both skies.
#pragma once

#include "pipeline/light/hole_optics.h"
#include "pipeline/light/spherical_lens.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Makes them without tables, with the own side's sky first.
HoleOptics make_wormhole_optics(const Wormhole& wormhole, const ObserverState& observer);

class WormholeLens : public SphericalLens {
 public:
  WormholeLens(std::shared_ptr<const HoleOptics> optics, const PerSky<M33d>& axes,
               const Wormhole& wormhole, double l)
      : SphericalLens(std::move(optics), axes), view_{wormhole, l} {}

  std::optional<BodyImage> body_image(double null_time, const BodyMotion& motion, int order,
                                      double radius) const override {
    return image_of_body(view_, null_time, motion, order, radius);
  }

 private:
  WormholePlaceView view_;
};

}  // namespace domefall
