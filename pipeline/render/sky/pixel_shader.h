// The light of the skies in pixels, each of which is looked at: exact, and not the quickest.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/render/rays/view_tracer.h"
#include "pipeline/render/scene/sky_light.h"
#include "pipeline/render/sky/anti_aliasing.h"
#include "pipeline/render/sky/sky_sampler.h"

namespace domefall {

// Where one sky is drawn by other means: looks on it within the cap are dark.
struct DarkenedCap {
  SkyRegion sky;
  CameraDirection centre;
  double chord2;  // of the cap's radius, squared
};

// Column and row from 0.
struct Pixel {
  int column, row;
};

class PixelShader {
 public:
  // By SkyRegion; null for a dark one.  Everything must outlive it.
  using Skies = PerSky<const Sky*>;
  PixelShader(const Show& show, const FrameState& state, const HoleOptics& optics,
              const Skies& skies, AntiAliasing anti_aliasing = {},
              std::vector<DarkenedCap> darkened = {});

  // SkyStore-linear working-space values of pixels, which are all in the picture, into the rows of 3 columns()
  // floats of which `rgb` is row `first_row`.  What stands side by side is best named one after another.
  void fill(const std::vector<Pixel>& pixels, int first_row, float* rgb) const;

  const ViewTracer& tracer() const { return tracer_; }
  bool is_dark(SkyRegion sky) const { return skies_[sky] == nullptr; }
  // Null for a sky that is no map.
  const SkySampler* sampler(SkyRegion sky) const;
  // Of the light of a sky that is a map.
  MapShift shift(SkyRegion sky, double frequency_ratio) const;
  void shifts(SkyRegion sky, const double* frequency_ratio, int count, float* gain,
              float* tone) const;
  void shift_sides(SkyRegion sky, const double* frequency_ratio, int count, float* red,
                   float* blue) const;
  float knee(SkyRegion sky) const;

 private:
  // Up to so many looks at once.
  struct Looks;
  struct Maps;

  void shade(Looks& looks, bool fine) const;
  void shade_batch(Looks& looks, int first, int count, bool fine, Maps& maps) const;
  void put_maps(const ViewRayBatch& batch, const Looks& looks, int first, int count, bool fine,
                Maps& maps) const;
  bool is_darkened(SkyRegion sky, const CameraDirection& n) const;
  WorkingRgb light(const ViewRayBatch& batch, int k, double sample_angle, bool fine) const;
  double amplification(const CameraDirection& n, double pixel_angle) const;
  bool needs_more_samples(const ViewRayBatch& batch, int k, double pixel_angle) const;
  void supersample(const std::vector<Pixel>& pixels, int first_row, float* rgb) const;
  float* pixel(const Pixel& at, int first_row, float* rgb) const {
    return rgb + 3 * (static_cast<std::size_t>(at.row - first_row) *
                          static_cast<std::size_t>(columns(projection_)) +
                      static_cast<std::size_t>(at.column));
  }

  const Show& show_;
  Projection projection_;
  ViewTracer tracer_;
  Skies skies_;
  std::vector<DarkenedCap> darkened_;
  AntiAliasing anti_aliasing_;
  bool amplified_;  // see Amplification::kEverything
  PerSky<std::optional<SkySampler>> samplers_;
  PerSky<double> scale_;  // pixel value per cd/m^2, by SkyRegion, with its gain
  double null_time_;
};

}  // namespace domefall
