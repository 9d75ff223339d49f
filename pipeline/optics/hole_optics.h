// Everything light does between the skies and the rain frame at one radius.  Frames of equal r
// share one; aberration, camera and projection stay outside.
#pragma once

#include <optional>

#include "pipeline/optics/sky_table.h"
#include "trajectories/observer_state.h"

namespace domefall {

// Which tables to make: what a black sky would show is not worth one.
struct WantedSkies {
  bool one = true, three = true;
};

struct HoleOptics {
  double r = kFlatSpace;
  Region region = Region::kI;
  std::optional<SkyTable> sky_one, sky_three;
};

// r = kFlatSpace: no table at all.  Regions I and II, the second for r <= 2; sky III is there for
// r < 2 only.
HoleOptics make_hole_optics(Region region, double r, WantedSkies wanted);

// One image of a point of the sky, in the rain frame.
struct SkyImage {
  TetradDirection direction;
  double frequency_ratio;  // observed by the rain observer / emitted: 1/(1+z)
  double amplification;    // solid angle of the image / of the source; inf on the axis of a lens
};

// The k-th image of the point `source` (unit, components along R, Theta, Phi): k = 0 is the primary,
// odd k lie on the opposite side of the hole, swept azimuth phi* + k pi or (k+1) pi - phi*.
// axis_blur (radians, > 0) is the angular radius of the source, which bounds the amplification where
// the source, the hole and the observer are in line.  Flat space: k = 0 only.
SkyImage image_of(const HoleOptics& optics, const SkyTable* table, const V3d& source, int order,
                  double axis_blur);

// The primary image, in the rain frame, of a direction on sky I without making a table: for aiming a
// camera.  Exact to 1e-14.
TetradDirection primary_image(double r, const V3d& source);

}  // namespace domefall
