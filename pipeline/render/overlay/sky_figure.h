// Figures of constellations as the lens and the motion of an observer show them.
#pragma once

#include <vector>

#include "pipeline/render/overlay/coverage.h"
#include "pipeline/render/scene/star_sight.h"

namespace domefall {

// A DirectSky knows where the direct image of each place on the observer's own sky is seen.
class DirectSky {
 public:
  // The state and the effects must outlive this object.
  DirectSky(const FrameState& state, const Effects& effects);

  // Says whether that sky is seen at all.
  bool is_seen() const { return sight_.sees(sky_); }
  CameraDirection image(const SkyDirection& place) const {
    return sight_.image(sky_, place, 0).direction;
  }

 private:
  SkyRegion sky_;
  StarSight sight_;
};

// Adds lines through places on the sky, clear of the places themselves, where stars stand.  A line
// is broken where its images jump from one side of the hole to the other.
void add_figure(const SkyFigure& figure, const DirectSky& sky, const Projection& projection,
                Coverage& coverage);

}  // namespace domefall
