// Looks at a sky map, many at a time: the inner loop of the sky.  SkyMap::sample is its oracle.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/sky/sky_map.h"

namespace domefall {

// Where pixels that stand side by side look, and what becomes of the light.
struct SkyPlaces {
  static constexpr int kSize = 512;
  using Column = std::array<float, kSize>;
  alignas(64) Column x, y, z;     // on the sky; of any length near 1
  alignas(64) Column gain;        // pixel value per unit of the map
  alignas(64) Column tone;        // log2 of the frequency ratio; thermal maps only
  alignas(64) Column wide;        // the longer side of the footprint, radians on the sky
  alignas(64) Column narrow;      // the shorter one; looked at with several taps only
  alignas(64) Column ax, ay, az;  // along the longer side, as long as it; likewise
};

class SkySampler {
 public:
  // The map must outlive it.
  explicit SkySampler(const SkyMap& map);

  // How many looks in a line an oblong footprint takes, so that they stand no farther apart than 1.5
  // times its width or the finest texel's (what a look between texels gathers is 2 wide): one of a few
  // numbers up to `most`.
  int taps(double wide, double narrow, int most = kMostTaps) const;
  static constexpr int kMostTaps = 32;

  // The same for many, from element `first` of `places` on; 1 for those longer than `longest`.
  void taps(const SkyPlaces& places, int first, int count, int most, float longest,
            std::uint8_t* out) const;

  // Whether the looks of a footprint need coarser levels than the finest.
  bool is_minified(double wide, double narrow, int taps) const {
    return blur(wide, narrow, taps) > texel_;
  }

  // rgb[3 * count + 1]: the last is overwritten too, with 0 or what it was.
  // minified: whether any of the looks is.
  void sample(const SkyPlaces& places, int count, int taps, bool minified, float* rgb) const;

  // The same of looks with a number of taps each, one of those that taps() gives; where it is 0, rgb is left
  // as it is.
  void sample_each(const SkyPlaces& places, int count, const std::uint8_t* taps, float* rgb) const;

  const SkyMap& map() const { return map_; }

 private:
  bool any_minified(const SkyPlaces& places, int count, int taps) const;

  static constexpr double kSpacing = 1.5;
  static constexpr std::array<int, 10> kTaps{1, 2, 3, 4, 6, 8, 12, 16, 24, kMostTaps};
  // How wide each of its looks is.
  static double blur(double wide, double narrow, int taps) {
    return taps == 1 ? wide : std::max(narrow, wide / (taps * kSpacing));
  }

  const SkyMap& map_;
  double texel_;  // radians, of the finest level
};

}  // namespace domefall
