// A TextSurface says how a text lies on the dome.
//
// The flat text is bent onto the sphere by Mercator's projection, about a pole on the meridian of
// the text's middle.  This projection is conformal, so that letters keep their form.  The lines of
// text run along circles about the pole, and the vertical of each letter points to the pole.  Up to
// 60 degrees of elevation the pole is the zenith.  Then every letter stands upright for people who
// turn towards it, however long the text is.  Around the zenith such a line would be a narrow ring.
// Therefore the pole moves away from the zenith for elevations above 60 degrees, until the line is
// a great circle for a text in the zenith.
#pragma once

#include "pipeline/lettering/lettering.h"
#include "projections/projection.h"
#include "trajectories/directions.h"

namespace domefall {

class TextSurface {
 public:
  // The middle of the text is at this elevation and at this azimuth, which counts from the front to
  // the right.  A unit of the text, the height of a capital, becomes `height`.  All three are in
  // radians.  `camera_from_audience` is as audience_axes() has it.
  TextSurface(const M33d& camera_from_audience, double azimuth, double elevation, double height);

  CameraDirection direction(const TextPoint& p) const;

  // Returns the angle about the pole, in radians, over which a text of this half width reaches to
  // either side.  With more than pi the text would run into itself.
  double angle_about_pole(double half_width) const { return half_width * scale_; }

 private:
  V3d right_, front_, pole_;  // along the camera's axes; the middle is on the meridian of front_
  double scale_;              // radians about the pole for a unit of text
  double start_;              // Mercator's ordinate of the middle
};

}  // namespace domefall
