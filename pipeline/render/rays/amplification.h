// How much larger a small patch of a sky appears than it is.
#pragma once

namespace domefall {

// A ray and its neighbours, where it matters to the size of an image: in the frame of the reference
// tetrad the angle from the axis, the azimuth that the ray sweeps and d azimuth/d angle, and the
// frequency seen in the picture's frame over the tetrad's.  Straight light: any equal angles, slope 1.
struct RayBundle {
  double angle = 1, azimuth = 1;
  double slope = 1;    // > 0
  double doppler = 1;  // > 0
};

// f of [Riazuelo] eq. eq_ampl, solid angle of the image over that of its source, for an image that is
// `width` (radians of view, > 0) across:
//     f = |sin angle| / (|sin azimuth| slope doppler^2),
// the sines averaged over the width and over the azimuths that it sweeps.  Averaged so, 1/f is the
// mean of its values across the image: what the image covers of the sky, counted as often as it is
// covered.  On a caustic, where sin azimuth = 0, f stays finite, of the order of 1/width.
double amplification(const RayBundle& bundle, double width);

}  // namespace domefall
