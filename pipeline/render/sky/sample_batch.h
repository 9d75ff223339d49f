// Samples of a sky map, many at a time: where each is taken, over which footprint, with which shift
// of its light, and by which filter.
#pragma once

#include <array>
#include <cstdint>

namespace domefall {

struct SampleBatch {
  static constexpr int kSize = 512;
  using Column = std::array<float, kSize>;
  alignas(64) Column x, y, z;  // direction on the sky, of any length near 1
  alignas(64) Column gain;     // pixel value per unit of the map
  alignas(64) Column tone;     // log2 of the frequency ratio; thermal maps only
  // The sides of the footprint, radians on the sky.  Only filters of several taps read the shorter
  // one.
  alignas(64) Column wide, narrow;
  alignas(64) Column ax, ay, az;  // along the longer side, as long as it; for several taps only
};

// How a footprint is averaged: by how many taps in a line along it, and whether these need coarser
// levels of the map than the finest.  A sample of 0 taps is not taken at all.
class SampleFilter {
 public:
  SampleFilter() = default;
  constexpr SampleFilter(int taps, bool minified)
      : code_(static_cast<std::uint8_t>(2 * taps + (minified ? 1 : 0))) {}
  constexpr int taps() const { return code_ / 2; }
  constexpr bool minified() const { return code_ % 2 != 0; }
  // One tap at the finest level.
  constexpr bool is_plain() const { return *this == SampleFilter(1, false); }
  constexpr std::uint8_t code() const { return code_; }
  constexpr bool operator==(const SampleFilter&) const = default;

 private:
  std::uint8_t code_ = 0;
};

}  // namespace domefall
