// A FormulaShader computes the light of skies that are formulas, the grid and the rings, in pixels
// whose view rays are interpolated.  PixelShader, which traces every ray, is its oracle.
#pragma once

#include <numbers>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/sky_light.h"
#include "pipeline/render/sky/sample_batch.h"

namespace domefall {

// On the grid, a pixel is the mean of samples where a border may cross it.  The corners of a pixel
// are this far from its middle, in units of its edges.  A blur by the footprint would know neither
// the slope of a border nor its position in the pixel.
inline constexpr double kGridReach = std::numbers::sqrt2 / 2;

class FormulaShader {
 public:
  // The light must be that of the grid or of rings, and must outlive this object.  `null_time` is
  // the observer's (M).  On the grid, a pixel that a border may cross is the mean of `samples`
  // samples along each axis, or of kMostSamples if that is less.
  static constexpr int kMostSamples = 16;
  FormulaShader(const SkyLight& light, double null_time, int samples);

  // A RingNode says where a ray ends on rings.  `phase` is in periods, minus a whole number that is
  // the same for the whole frame.  `width` is how much of a period a pixel of that angle (radians)
  // covers.
  struct RingNode {
    float phase, width;
  };
  RingNode ring_node(double emission_time, double time_scale, double pixel_angle) const;
  // An interpolated phase may always have this error, which changes the light by less than the
  // rounding of a half float.
  static constexpr float kPhaseTolerance = 1e-4f;

  // Writes the pixel values of count <= SampleBatch::kSize pixels.  They form squares of kSide by
  // kSide pixels, each of which is stored row by row.  On the grid, gain and tone are those of
  // SkyLight::grid_shift.  Rings have their phase in column x and its width in column wide.
  static constexpr int kSide = 8;
  void shade(const SampleBatch& pixels, int count, float* rgb) const;

 private:
  struct Squares;
  struct BorderSamples;
  void shade_grid(const SampleBatch& pixels, int count, float* rgb) const;
  void shade_rings(const SampleBatch& pixels, int count, float* rgb) const;
  void find_squares(const SampleBatch& pixels, int count, Squares& seen) const;
  void sample_borders(const SampleBatch& pixels, int count, Squares& seen) const;

  const SkyLight& light_;
  double phase_ = 0, per_time_ = 0;  // of rings: phase of the observer's time, and periods per M
  int samples_;
};

}  // namespace domefall
