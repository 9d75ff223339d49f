// The amplification of a small patch of a sky: how much larger it appears than it is.
#pragma once

namespace domefall {

// What the size of an image depends on, about one ray.  Angle, azimuth and slope belong to the
// frame of the reference tetrad.  Straight light has an angle equal to its azimuth, whatever both
// are, and a slope of 1.
struct RayBundle {
  double angle = 1;    // from the axis, radians
  double azimuth = 1;  // that the ray sweeps, radians
  double slope = 1;    // |d azimuth/d angle|, > 0
  double doppler = 1;  // frequency for the observer who is drawn over that in the tetrad, > 0
};

// f of [Riazuelo] eq. eq_ampl, the solid angle of an image over that of its source, for an image of
// `width` (radians in the view, > 0):
//     f = |sin angle| / (|sin azimuth| slope doppler^2).
// Both sines are averaged, the first over the width and the second over the azimuths that the width
// sweeps, so that 1/f is the mean of its values across the image: the part of the sky that the
// image covers, counted as often as it is covered.  On a caustic, where sin azimuth = 0, f stays
// finite, of the order of 1/width.
double amplification(const RayBundle& bundle, double width);

}  // namespace domefall
