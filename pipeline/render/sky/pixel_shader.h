// A PixelShader computes the light of the skies in pixels all of whose view rays are traced, which
// is exact but slow.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/render/sky/anti_aliasing_settings.h"
#include "pipeline/render/sky/formula_shader.h"
#include "pipeline/render/sky/sky_sampler.h"

namespace domefall {

// A DarkenedCap is a cap of the view in which one sky is drawn by other means, so that its rays
// there stay dark.
struct DarkenedCap {
  SkyRegion sky;
  CameraDirection centre;
  double chord2;  // squared chord from the centre to the rim
};

// The column and row of a Pixel count from 0.
struct Pixel {
  int column, row;
};

class PixelShader {
 public:
  // The scene must outlive this object.
  explicit PixelShader(const FrameScene& scene, AntiAliasing anti_aliasing = {},
                       std::vector<DarkenedCap> darkened = {});

  // Writes scene-linear working-space values of `pixels`, all of which must lie in the image.  They
  // are written into rows of 3 columns() floats, of which the row `first_row` begins at `rgb`.  The
  // function is faster if neighbouring pixels follow one another, since they share cache lines of
  // the sky.
  void fill(const std::vector<Pixel>& pixels, int first_row, float* rgb) const;

  const FrameScene& scene() const { return scene_; }
  // Returns null for a sky that is no map.
  const SkySampler* sampler(SkyRegion sky) const {
    return samplers_[sky] ? &*samplers_[sky] : nullptr;
  }
  // Returns null for a sky that is no formula.
  const FormulaShader* formula(SkyRegion sky) const {
    return formulas_[sky] ? &*formulas_[sky] : nullptr;
  }

 private:
  struct Samples;
  struct MapSamples;
  struct GridSamples;

  void shade(Samples& samples, bool fine) const;
  void shade_batch(Samples& samples, int first, int count, bool fine, MapSamples& maps) const;
  void put_maps(const ViewRayBatch& rays, const Samples& samples, int first, int count, bool fine,
                MapSamples& maps) const;
  bool is_darkened(SkyRegion sky, const CameraDirection& n) const;
  bool is_grid(SkyRegion sky) const;
  // A fine sample is one of many in its pixel.
  void find_grids(const ViewRayBatch& rays, const double* angle, int count, bool fine,
                  GridSamples& grid) const;
  WorkingRgb light(const ViewRayBatch& rays, int k, double sample_angle,
                   const GridSamples& grid) const;
  double amplification(const CameraDirection& n, double pixel_angle) const;
  bool needs_more_samples(const ViewRayBatch& rays, int k, double pixel_angle,
                          const GridSamples& grid) const;
  void supersample(const std::vector<Pixel>& pixels, int first_row, float* rgb) const;
  float* pixel(const Pixel& at, int first_row, float* rgb) const {
    return rgb + 3 * (static_cast<std::size_t>(at.row - first_row) *
                          static_cast<std::size_t>(columns(scene_.projection())) +
                      static_cast<std::size_t>(at.column));
  }

  const FrameScene& scene_;
  std::vector<DarkenedCap> darkened_;
  AntiAliasing anti_aliasing_;
  PerSky<std::optional<SkySampler>> samplers_;
  PerSky<std::optional<FormulaShader>> formulas_;
};

}  // namespace domefall
