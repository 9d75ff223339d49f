// The amplification of a small patch of a sky says how much larger it appears than it is.
#pragma once

#include <variant>

namespace domefall {

// A SkyPatch says how the sky is seen about a ray in the frame of a lens: `area` is the solid angle of
// a patch of the sky over that of its image, the product of the derivative's two scales.  It changes
// by `change` per radian of view where it changes fastest.
struct SkyPatch {
  double area = 1, change = 0;  // >= 0
};
// An AxisPatch says the same for a lens that light leaves in the plane of an axis and the ray.  A
// ring about the axis, of solid angle 2 pi sin(angle) d angle, is the image of one of solid angle
// 2 pi sin(azimuth) d azimuth, so the area is |sin azimuth| slope/sin angle.
struct AxisPatch {
  double angle;    // of the ray from the axis, radians
  double azimuth;  // that the light sweeps, radians
  double slope;    // |d azimuth/d angle|, > 0
};

// A RayBundle holds what the size of an image about one ray depends on.
struct RayBundle {
  std::variant<SkyPatch, AxisPatch> patch;
  double doppler = 1;  // frequency for the observer who is drawn over that in the lens's frame, > 0
};

// Returns the solid angle of an image over that of its source, for an image of `width` (radians in
// the view, > 0): f = 1/(area doppler^2), since the boost from the lens's frame to the view divides
// solid angles by doppler^2.  With an axis this is [Riazuelo] eq. eq_ampl.
//
// 1/f is the mean of its values across the image: the part of the sky that the image covers, counted
// as often as it is covered.  So on a caustic, where the area is 0, f stays finite, of the order of
// 1/width.  The mean of an area that changes evenly is taken along the line on which it changes, and
// with an axis that of both sines, the first over the width and the second over the azimuths that
// the width sweeps.
double amplification(const RayBundle& bundle, double width);

}  // namespace domefall
