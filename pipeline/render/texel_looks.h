// Looks between the texels of a map that wait to be taken: of many pixels, each as many times as it needs.
// Where all of them fall is known before the first is taken, so that the memory can be asked in time.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/render/sky_texels.h"

namespace domefall {

// Pixels whose looks are of one kind: `taps` in a line along (ax, ay, az), each `blur` wide at least.
struct LinesOfLooks {
  int taps = 1, members = 0;
  bool minified = false;
  const float *x, *y, *z;      // on the sky
  const float *wide, *narrow;  // radians; narrow: of several taps only
  const float *ax, *ay, *az;   // of several taps only
  const std::uint16_t* who;    // the pixels' numbers
};

// Between which texels looks fall, and by what their light is multiplied.
struct TexelSpots {
  static constexpr int kMost = 2048;
  alignas(64) std::array<std::int32_t, kMost> at, level;
  alignas(64) std::array<float, kMost> fx, fy, weight;
};

class TexelLooks {
 public:
  static constexpr int kMost = TexelSpots::kMost;
  // Looks that `lines` may be at most: others do not fit in at once.
  static constexpr int kMostOfLines = 512;

  // spacing: how far apart the looks of a line are, in their widths.
  TexelLooks(const SkyMap& map, double spacing);

  bool has_room() const { return count_ + 2 * kMostOfLines <= kMost; }
  // taps * members <= kMostOfLines; has_room().
  void add(const LinesOfLooks& lines);

  // Adds the light of all looks to the sums of their pixels, 1/kTexelScale of what it is, and forgets them.
  void take(Four* sums);

 private:
  void add_members(const LinesOfLooks& lines, int times);

  TexelLevels levels_;
  int size_, last_;
  float per_texel_, spacing_;
  int count_ = 0;
  TexelSpots spots_;
  alignas(64) std::array<std::uint16_t, kMost> who_;
};

}  // namespace domefall
