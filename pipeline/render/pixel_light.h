// The light of the skies in a row of pixels.
#pragma once

#include "pipeline/render/anti_aliasing.h"
#include "pipeline/render/scene.h"
#include "pipeline/render/view_tracer.h"

namespace domefall {

// Light of a sky's background (cd/m^2, times `scale`) at frequency ratio
// g = 1/(1+z), filtered over `footprint` radians on the sky, with the show's effects but its
// amplification.  [Riazuelo] sec. ssec_rgb for panoramas, which have no spectrum to shift.
WorkingRgb background_light(const Sky& sky, const Show& show, const V3d& sky_direction,
                            double footprint, double g, double scale);

// Where one sky is drawn by other means: looks on it within the cap are dark.
struct DarkenedSpot {
  SeenSky sky;
  CameraDirection centre;
  double chord2;  // of the cap's radius, squared
};

class PixelLight {
 public:
  // By SeenSky; null for a dark one.  Everything must outlive it.
  using Skies = std::array<const Sky*, kSkies>;
  PixelLight(const Show& show, const FrameState& state, const HoleOptics& optics,
             const Skies& skies, AntiAliasing anti_aliasing = {},
             std::vector<DarkenedSpot> darkened = {});

  // Scene-linear working-space pixel values of row `row` (from 0) into rgb[3 * columns].
  void fill_row(int row, float* rgb) const;

 private:
  void shade(const LookBatch& batch, const CameraDirection* n, int count,
             const double* sample_angle, bool fine, float* rgb) const;
  bool is_darkened(SeenSky sky, const CameraDirection& n) const;
  WorkingRgb light(const LookBatch& batch, int k, double sample_angle, bool fine) const;
  double amplification(const CameraDirection& n, double pixel_angle) const;
  bool needs_more_samples(const LookBatch& batch, int k, double pixel_angle) const;
  void supersample(int row, const std::vector<int>& pixels, float* rgb) const;

  const Show& show_;
  Projection projection_;
  ViewTracer tracer_;
  Skies skies_;
  std::vector<DarkenedSpot> darkened_;
  AntiAliasing anti_aliasing_;
  double long_footprint_;
  bool amplified_;                    // see Amplification::kEverything
  std::array<double, kSkies> scale_;  // pixel value per cd/m^2, by SeenSky, with its gain
  double null_time_;
};

}  // namespace domefall
