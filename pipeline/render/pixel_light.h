// The light of the skies in a row of pixels.
#pragma once

#include "pipeline/render/anti_aliasing.h"
#include "pipeline/render/scene.h"
#include "pipeline/render/view_tracer.h"

namespace domefall {

class PixelLight {
 public:
  // By SeenSky; null for a dark one.  Everything must outlive it.
  using Skies = std::array<const Sky*, kSkies>;
  PixelLight(const Show& show, const FrameState& state, const HoleOptics& optics,
             const Skies& skies, AntiAliasing anti_aliasing = {});

  // Scene-linear working-space pixel values of row `row` (from 0) into rgb[3 * columns].
  void fill_row(int row, float* rgb) const;

 private:
  void shade(const LookBatch& batch, int count, const double* sample_angle, bool fine,
             float* rgb) const;
  WorkingRgb light(const LookBatch& batch, int k, double sample_angle, bool fine) const;
  bool needs_more_samples(const LookBatch& batch, int k, double pixel_angle) const;
  void supersample(int row, const std::vector<int>& pixels, float* rgb) const;

  const Show& show_;
  Projection projection_;
  ViewTracer tracer_;
  Skies skies_;
  AntiAliasing anti_aliasing_;
  double long_footprint_;
  double scale_;  // pixel value per cd/m^2
};

}  // namespace domefall
