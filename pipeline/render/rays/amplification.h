// The amplification of a small patch of a sky says how much larger it appears than it is.
#pragma once

namespace domefall {

// A RayBundle holds what the size of an image about one ray depends on.  Angle, azimuth and slope
// belong to the frame of the reference tetrad.  The defaults suit straight light, whose angle and
// azimuth are equal, whatever they are, and whose slope is 1.
struct RayBundle {
  double angle = 1;    // from the axis, radians
  double azimuth = 1;  // that the ray sweeps, radians
  double slope = 1;    // |d azimuth/d angle|, > 0
  double doppler = 1;  // frequency for the observer who is drawn over that in the tetrad, > 0
};

// Returns f of [Riazuelo] eq. eq_ampl, the solid angle of an image over that of its source, for an
// image of `width` (radians in the view, > 0):
//     f = |sin angle| / (|sin azimuth| slope doppler^2).
// The lens turns a ring of solid angle 2 pi sin(azimuth) d azimuth into a ring of solid angle
// 2 pi sin(angle) d angle.  The boost from the tetrad to the view divides solid angles by
// doppler^2.
//
// Both sines are averaged, the first over the width and the second over the azimuths that the width
// sweeps.  So 1/f is the mean of its values across the image: the part of the sky that the image
// covers, counted as often as it is covered.  On a caustic, where sin azimuth = 0, f stays finite,
// of the order of 1/width.
double amplification(const RayBundle& bundle, double width);

}  // namespace domefall
