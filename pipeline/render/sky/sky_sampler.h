// A SkySampler takes many samples of one sky map at a time, which is the inner loop of the sky.
// SkyMap::sample is its oracle.
#pragma once

#include "pipeline/render/sky/sample_batch.h"
#include "pipeline/sources/sky/sky_map.h"

namespace domefall {

class SkySampler {
 public:
  // The map must outlive the sampler.  `black`, in units of the map, is subtracted from each
  // sample.  For a colour map it is subtracted from the luminance, which keeps the hue, and for a
  // thermal map from the radiance.
  explicit SkySampler(const SkyMap& map, double black = 0);

  static constexpr int kMostTaps = 32;
  // Chooses filters by the longer and the shorter side of footprints (radians on the sky).  An
  // oblong footprint takes one of a few numbers of taps up to `most_taps`.  The taps stand no
  // farther apart than 1.5 times the footprint's width, or 1.5 of the finest texels, since a tap
  // gathers light from 2 of its widths.  Where `most_taps` are too few for that, the taps become
  // wider.  A footprint longer than `longest_line` has one tap as wide as it is long.
  void choose_filters(const float* wide, const float* narrow, int count, int most_taps,
                      float longest_line, SampleFilter* filters) const;

  // Writes scene-linear working-space values into rgb[3 * count + 1].  The values of samples
  // without taps do not change.  The element behind the last value may be overwritten with 0.
  void sample(const SampleBatch& batch, int count, const SampleFilter* filters, float* rgb) const;
  // Does the same for samples whose filters are all plain.
  void sample_plain(const SampleBatch& batch, int count, float* rgb) const;

  const SkyMap& map() const { return map_; }

 private:
  const SkyMap& map_;
  float texel_;  // the width of a texel of the finest level, radians
  float black_;
};

}  // namespace domefall
