// The light of the skies in pixels, each of which is looked at: exact, and not the quickest.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/render/anti_aliasing.h"
#include "pipeline/render/sky_light.h"
#include "pipeline/render/sky_sampler.h"
#include "pipeline/render/view_tracer.h"

namespace domefall {

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

  // Scene-linear working-space pixel values of the pixels of row `row` (from 0) that are inside `range`
  // and the picture, into rgb[3 * columns].  The others are left alone.
  void fill(int row, ColumnRange range, float* rgb) const;

  const ViewTracer& tracer() const { return tracer_; }
  bool is_dark(SeenSky sky) const { return skies_[static_cast<std::size_t>(sky)] == nullptr; }
  // Null for a sky that is no map.
  const SkySampler* sampler(SeenSky sky) const;
  // Of the light of a sky that is a map.
  MapShift shift(SeenSky sky, double frequency_ratio) const;
  ShiftSides shift_sides(SeenSky sky, double frequency_ratio) const;
  float knee(SeenSky sky) const;

 private:
  void shade(const LookBatch& batch, const CameraDirection* n, int count,
             const double* sample_angle, bool fine, float* rgb) const;
  void add_map(SeenSky sky, const LookBatch& batch, const CameraDirection* n, int count,
               const double* sample_angle, bool fine, float* rgb) const;
  // Whether the look needs more than the finest level.
  bool put_place(SeenSky sky, const LookBatch& batch, int k, double sample_angle, int taps,
                 SkyPlaces& places, int member) const;
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
  bool amplified_;  // see Amplification::kEverything
  std::array<std::optional<SkySampler>, kSkies> samplers_;
  std::array<double, kSkies> scale_;  // pixel value per cd/m^2, by SeenSky, with its gain
  double null_time_;
};

}  // namespace domefall
