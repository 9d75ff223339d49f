// Computes the background of one sky as a frame shows it: its light in a direction, and how a
// frequency ratio changes this light.
//
// A background with spectra (the grid, thermal maps) is seen at the shifted temperature.  A colour
// panorama has no spectrum to shift, so it keeps its hue and a law of intensity scales it
// ([Riazuelo] sec. ssec_rgb).
#pragma once

#include "pipeline/render/scene/sky_store.h"
#include "pipeline/sources/sky/formula_sky.h"

namespace domefall {

// A LightShift says how a frequency ratio changes the light of a background.
struct LightShift {
  float gain;  // the pixel value per unit of the map, or per cd/m^2
  float tone;  // log2 of the factor to the temperatures of a thermal map; 0 for colours
};

class SkyLight {
 public:
  // `scale` is the pixel value of 1 cd/m^2, with the gain of this sky's background.  The sky must
  // outlive this object.
  SkyLight(const Sky& sky, const Effects& effects, const PanoramaShift& panorama_shift,
           double scale);

  const Sky& sky() const { return *sky_; }
  // Returns null unless the background is a map.
  const SkyMap* map() const { return map_; }

  bool is_grid() const { return std::holds_alternative<Grid>(sky_->background); }
  // Returns null unless the background is rings.
  const Rings* rings() const { return std::get_if<Rings>(&sky_->background); }

  // Returns what is subtracted from the map's light before anything else is done to it, in units of
  // the map.  It is subtracted from the luminance of a colour map, so that the hue is kept, and
  // from the radiance of a thermal map.
  double black() const { return black_; }

  // Returns the pixel value of the grid or a map in a direction of the sky, averaged over
  // `footprint` radians there, at frequency ratio g = 1/(1+z), with the effects that the show
  // keeps.  The caller applies the amplification.  A black sky gives 0.
  WorkingRgb at(const V3d& sky_direction, double footprint, double g) const;
  // Returns the pixel value of light of the grid at frequency ratio g.  The background must be the
  // grid.
  WorkingRgb grid_at(const GridLight& light, double g) const;
  // Returns the pixel value per cd/m^2 of the grid at the seen temperature as gain, and the factor
  // to its temperatures, not the logarithm of it, as tone.
  LightShift grid_shift(double g) const;
  // Returns the pixel value per cd/m^2 of rings.
  WorkingRgb ring_colour() const;
  // Returns the pixel value of rings at `phase` (emission time in periods), averaged over `width`
  // periods.  The background must be rings.
  WorkingRgb rings_at(double phase, double width) const;

  // The background must be a map for the functions that follow.  Many ratios at once, count <=
  // kMostShifts, give the same bits as one at a time.
  static constexpr int kMostShifts = 128;
  LightShift shift(double g) const;
  void shifts(const double* g, int count, float* gain, float* tone) const;
  // The gain of a colour panorama has a knee at g = 1, where one law takes over from another.  This
  // computes the gains by the laws of both sides for any g.  Each is smooth and can be
  // interpolated.  The blue one holds where the red one exceeds knee(), the gain at g = 1.
  void shift_sides(const double* g, int count, float* red, float* blue) const;
  float knee() const;

 private:
  double intensity(double g) const;
  float gain_of(double intensity) const;

  const Sky* sky_;
  const SkyMap* map_;
  Effects effects_;
  PanoramaShift panorama_shift_;
  double scale_;
  double black_;
};

}  // namespace domefall
