// Where one observer sees the images of a star, by the exact inverse of the tables: for names and
// questions about single stars.  The renderer's StarImageFinder finds those of millions.
#pragma once

#include "pipeline/optics/hole_optics.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/vantage.h"
#include "projections/projection.h"

namespace domefall {

class StarSight {
 public:
  // The show and the state must outlive this.
  StarSight(const Show& show, const FrameState& state);

  // Whether stars of that sky are seen at all.
  bool sees(SkyRegion sky) const;
  // The number of images that a star has and the renderer looks for: 1 where light goes straight,
  // and 2 where all are equally bright.
  int orders() const;

  struct Image {
    CameraDirection direction;
    // The flux, as the renderer draws it under the show's effects, over the star's.
    double brightening;
  };
  // The image of an order (image_of) below orders().
  Image image(SkyRegion sky, const SkyDirection& star, int order) const;

 private:
  const Effects& effects_;
  const ObserverState& observer_;
  Vantage vantage_;
  HoleOptics optics_;
};

}  // namespace domefall
