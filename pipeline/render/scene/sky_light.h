// The background of one sky as a frame shows it: its light in a direction, and what a frequency ratio
// does to it.
//
// A background with spectra (the grid, thermal maps) is seen at the shifted temperature.  A colour
// panorama has no spectrum to shift: [Riazuelo] sec. ssec_rgb keeps its hue and scales it by a law
// of intensity.
#pragma once

#include "pipeline/render/scene/sky_store.h"

namespace domefall {

// What SkySampler applies to the values of a map.
struct MapShift {
  float gain;  // pixel value per unit of the map
  float tone;  // octaves by which the temperatures of a thermal map are raised; 0 for colours
};

class SkyLight {
 public:
  // scale: pixel value of 1 cd/m^2, with the gain of this sky's background.  The sky must outlive this.
  SkyLight(const Sky& sky, const Effects& effects, const PanoramaShift& panorama_shift,
           double scale);

  const Sky& sky() const { return *sky_; }
  // Null unless the background is a map.
  const SkyMap* map() const { return map_; }

  // Pixel value of the grid or a map in a direction of the sky, averaged over `footprint` radians there,
  // at frequency ratio g = 1/(1+z).  The effects that the show leaves out are left out, but for
  // amplification, which the caller applies.  0 for a black sky.
  WorkingRgb at(const V3d& sky_direction, double footprint, double g) const;
  // Pixel value of rings at `phase` (periods of the emission time), averaged over `width` periods.
  // Needs a background of rings.
  WorkingRgb rings_at(double phase, double width) const;

  // These need a background that is a map.  Many ratios at once give the same bits as one at a time;
  // count <= kMostShifts.
  static constexpr int kMostShifts = 128;
  MapShift shift(double g) const;
  void shifts(const double* g, int count, float* gain, float* tone) const;
  // The law of intensity of a panorama has a knee at g = 1.  These are the gains of its two sides, each
  // of which is smooth for any g and can be interpolated.  Blue holds where red exceeds knee().
  void shift_sides(const double* g, int count, float* red, float* blue) const;
  float knee() const;

 private:
  double intensity(double g) const;
  float gain_of(double shift) const;

  const Sky* sky_;
  const SkyMap* map_;
  Effects effects_;
  PanoramaShift panorama_shift_;
  double scale_;
};

}  // namespace domefall
