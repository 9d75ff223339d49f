// How a text lies on the dome.
//
// Letters keep their form: the flat text is bent onto the sphere by Mercator's projection, which
// is conformal, about a pole on the meridian of the text's middle.  Its lines run along circles
// about that pole, and the vertical of each letter points to it.  Up to 60 degrees of elevation
// the pole is the zenith, so that every letter stands upright for those who turn towards it,
// however long the text is.  Around the zenith such a line would be a narrow ring, so that from 60
// degrees on the pole moves away until, at the zenith, the line is straight (a great circle).
#pragma once

#include "pipeline/lettering/lettering.h"
#include "projections/projection.h"
#include "trajectories/directions.h"

namespace domefall {

class TextSurface {
 public:
  // The middle of the text is at this azimuth, to the right of the front, and elevation, and a unit
  // of the text is `height`, all in radians.  `camera_from_audience` is as audience_axes() has it.
  TextSurface(const M33d& camera_from_audience, double azimuth, double elevation, double height);

  CameraDirection direction(const TextPoint& p) const;

  // The radians by which a text of this half width reaches around the pole.  With more than pi it
  // would run into itself.
  double half_turn(double half_width) const { return half_width * scale_; }

 private:
  V3d right_, front_, pole_;  // of the camera's axes; the middle is on the meridian of front_
  double scale_;              // radians about the pole for a unit of text
  double start_;              // Mercator's ordinate of the middle
};

}  // namespace domefall
