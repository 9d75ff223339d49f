// Looks at a sky map, many at a time: the inner loop of the sky.  SkyMap::sample is its oracle.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/sky/maps/sky_map.h"

namespace domefall {

// Where pixels that stand side by side look, and what becomes of the light.
struct FootprintBatch {
  static constexpr int kSize = 512;
  using Column = std::array<float, kSize>;
  alignas(64) Column x, y, z;     // on the sky; of any length near 1
  alignas(64) Column gain;        // pixel value per unit of the map
  alignas(64) Column tone;        // log2 of the frequency ratio; thermal maps only
  alignas(64) Column wide;        // the longer side of the footprint, radians on the sky
  alignas(64) Column narrow;      // the shorter one; looked at with several taps only
  alignas(64) Column ax, ay, az;  // along the longer side, as long as it; likewise
};

// How a footprint is looked at: by how many looks in a line, and whether they need coarser levels of the map
// than the finest.  0 taps: not at all.
class SampleKind {
 public:
  SampleKind() = default;
  constexpr SampleKind(int taps, bool minified)
      : code_(static_cast<std::uint8_t>(2 * taps + (minified ? 1 : 0))) {}
  constexpr int taps() const { return code_ / 2; }
  constexpr bool minified() const { return code_ % 2 != 0; }
  // One look at the finest level.
  constexpr bool is_plain() const { return *this == SampleKind(1, false); }
  constexpr std::uint8_t code() const { return code_; }
  constexpr bool operator==(const SampleKind&) const = default;

 private:
  std::uint8_t code_ = 0;
};

class SkySampler {
 public:
  // The map must outlive it.
  explicit SkySampler(const SkyMap& map);

  static constexpr int kMostTaps = 32;
  // How footprints are to be looked at, by their longer and shorter sides (radians on the sky).  An oblong one
  // takes so many looks in a line that they stand no farther apart than 1.5 times its width or the finest
  // texel's (what a look between texels gathers is 2 wide): one of a few numbers up to `most`.  Those longer
  // than `longest` are looked at once.
  void choose_kinds(const float* wide, const float* narrow, int count, int most, float longest,
                    SampleKind* kinds) const;

  // rgb[3 * count + 1]: the last is overwritten too, with 0 or what it was.  Where there are no taps, the
  // colour stays what it was.
  void sample(const FootprintBatch& places, int count, const SampleKind* kinds, float* rgb) const;
  // The same of looks that are all plain.
  void sample_plain(const FootprintBatch& places, int count, float* rgb) const;

  const SkyMap& map() const { return map_; }

 private:
  const SkyMap& map_;
  float texel_;  // radians, of the finest level
};

}  // namespace domefall
