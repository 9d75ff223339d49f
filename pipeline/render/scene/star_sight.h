// Finds where one observer sees the images of a star, one by one.  It
// serves names and questions about single stars, while the renderer's StarImageFinder finds the
// images of millions.
#pragma once

#include <memory>

#include "pipeline/light/lens.h"
#include "pipeline/show/frame_state.h"
#include "pipeline/show/viewer.h"
#include "projections/projection.h"

namespace domefall {

class StarSight {
 public:
  // The state and the effects must outlive this object.
  StarSight(const FrameState& state, const Effects& effects);

  // Says whether stars of that sky are seen at all.
  bool sees(SkyRegion sky) const;
  // Returns the number of images of a star that the renderer looks for.  It is 1 where light goes
  // straight, and 2 where all images are equally bright.
  int orders() const;

  struct Image {
    CameraDirection direction;
    // `brightening` is the bolometric flux, as the renderer draws it under the show's effects, over
    // the star's own.  The frequency ratio is the one that is measured.
    double brightening, frequency_ratio;
  };
  // Returns the image of an order (image_of) below orders().
  Image image(SkyRegion sky, const SkyDirection& star, int order) const;

 private:
  const Effects& effects_;
  const ObserverState& observer_;
  Viewer viewer_;
  std::shared_ptr<const Lens> lens_;
  PerSky<std::unique_ptr<const SkyPoints>> points_;
};

}  // namespace domefall
