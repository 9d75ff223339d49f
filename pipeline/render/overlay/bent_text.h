// Texts in an image, flat or bent onto the dome.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/base/digest.h"
#include "pipeline/base/lettering.h"
#include "pipeline/render/overlay/coverage.h"
#include "projections/projection.h"
#include "trajectories/directions.h"

namespace domefall {

// A TextSurface says how a text lies on the dome.
//
// The flat text is bent onto the sphere by Mercator's projection, about a pole on the meridian of
// the text's middle.  This projection is conformal, so that letters keep their form.  The lines of
// text run along circles about the pole, and the vertical of each letter points to the pole.  Up to
// 60 degrees of elevation the pole is the zenith.  Then every letter stands upright for people who
// turn towards it, however long the text is.  Around the zenith such a line would be a narrow ring.
// Therefore the pole moves away from the zenith for elevations above 60 degrees, until the line is
// a great circle for a text in the zenith.
class TextSurface {
 public:
  // The middle of the text is at this elevation and at this azimuth, which counts from the front to
  // the right.  A unit of the text, the height of a capital, becomes `height`.  All three are in
  // radians.  `camera_from_audience` is as audience_axes() has it.
  TextSurface(const M33d& camera_from_audience, double azimuth, double elevation, double height);

  // The middle is where the camera sees something in this direction, or this angle (radians) below.
  static TextSurface at(const M33d& camera_from_audience, const CameraDirection& n, double height,
                        double below = 0);

  CameraDirection direction(const TextPoint& p) const;
  // Returns the point of the text that lies in a direction, which is infinitely high or low at the
  // pole and its opposite.
  TextPoint point(const CameraDirection& n) const;

  // Returns the angle about the pole, in radians, over which a text of this half width reaches to
  // either side.  With more than pi the text would run into itself.
  double angle_about_pole(double half_width) const { return half_width * scale_; }

 private:
  friend class TextRegion;
  V3d right_, front_, pole_;  // along the camera's axes; the middle is on the meridian of front_
  double scale_;              // radians about the pole for a unit of text
  double start_;              // Mercator's ordinate of the middle
};

// A TextRegion is the part of a surface within these half sides about the text's middle.
class TextRegion {
 public:
  TextRegion(const TextSurface& surface, double half_width, double half_height);

  // Says whether it holds a direction, in a tenth of the time that TextSurface::point() takes.
  bool holds(const CameraDirection& n) const {
    const double sine = n.v.dot(pole_), ahead = n.v.dot(front_);
    return sine > least_sine_ && sine < largest_sine_ &&
           ahead > least_cosine_ * std::sqrt(std::max(1 - sine * sine, 0.0));
  }

 private:
  V3d front_, pole_;
  double least_sine_, largest_sine_;  // of the latitudes about the pole
  double least_cosine_;               // of the angles about it
};

// Adds a text on a surface as the projection shows it.  The text is moved by `shift` on the
// surface.  Curves are followed to 1/20 pixel.  An outline is left out if it comes near to the one
// direction without an image.
void add_text(const LetteredText& text, const TextSurface& surface, const TextPoint& shift,
              const Projection& projection, Coverage& coverage);

// Adds a text that lies flat in the image, centred on `middle`.  On the screen capitals are so high,
// in the unit of ScreenSides.
void add_flat_text(const LetteredText& text, const ImagePoint& middle, double capital,
                   const ScreenSides& pixel, Coverage& coverage);

// Adds the outlines of a text, rounded to 1e-5 of a capital's height, to the key of a frame.  They
// depend on the machine's fonts.
void add_outlines(Digest& digest, const LetteredText& text);

}  // namespace domefall
