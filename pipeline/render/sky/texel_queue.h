// Looks between the texels of a map that wait to be taken: of many pixels, each as many times as it needs.
// Where all of them fall is known before the first is taken, so that the memory can be asked in time.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/render/sky/texel_sample.h"

namespace domefall {

// Pixels that are looked at in one way: `taps` times in a line along (ax, ay, az).
struct SampleLines {
  int taps = 1, members = 0;  // taps: 1 or an even number
  bool minified = false;
  const float *x, *y, *z;      // on the sky
  const float *wide, *narrow;  // radians; narrow: of several taps only
  const float *ax, *ay, *az;   // of several taps only
  const std::uint16_t* who;    // the pixels' numbers
};

class TexelQueue {
 public:
  // spacing: how far apart the looks of a line are, in their widths.
  TexelQueue(const SkyMap& map, double spacing);

  // The most members of such lines that may be added at once.
  static int most_members(int taps, bool minified) { return kAtOnce / pairs(taps, minified); }
  // sums: of pixels, in two parts that belong together.  They get the light of all looks that are taken to
  // make room, 1/kTexelScale of what it is.
  void add(const SampleLines& lines, Pair* sums);
  // Those of all the others.
  void take(Pair* sums);

  // Where looks fall on a level of the map, and by what their light is multiplied.  Two of them are taken at
  // a time, both of one pixel.
  static constexpr int kMost = 1024;
  struct TexelIndices {
    alignas(64) std::array<std::int32_t, kMost> at, level;
    alignas(64) std::array<float, kMost> fx, fy, weight;
  };

 private:
  static constexpr int kAtOnce = 512;
  // From so many looks a pixel on, each keeps to one level of the map.
  static constexpr int kManyTaps = 4;
  static bool on_two_levels(int taps, bool minified) { return minified && taps < kManyTaps; }
  static int pairs(int taps, bool minified) {
    return on_two_levels(taps, minified) ? taps : (taps + 1) / 2;
  }

  struct Queue {
    int count = 0;
    std::array<TexelIndices, 2> spots;
    alignas(64) std::array<std::uint16_t, kMost> who;
  };
  void locate(const SampleLines& lines, Queue& queue) const;

  TexelLevels levels_;
  int size_, last_;
  float per_texel_, spacing_;
  Queue finest_, any_;  // all at the finest level with the weight 1, and all others
};

}  // namespace domefall
