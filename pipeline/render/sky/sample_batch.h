// A SampleBatch holds many samples of a sky map: their directions, their footprints, and the shifts
// of their light.  Each has a SampleFilter.
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
  // These are the sides of the footprint, in radians on the sky.  Only filters of several taps read
  // the shorter side.
  alignas(64) Column wide, narrow;
  alignas(64) Column ax, ay, az;  // the longer side as a vector; for several taps only
};

// A SampleFilter says how a footprint is averaged: by how many taps in a line along it, and whether
// these need coarser levels of the map than the finest.  A sample of 0 taps is not taken at all.
class SampleFilter {
 public:
  SampleFilter() = default;
  constexpr SampleFilter(int taps, bool minified)
      : code_(static_cast<std::uint8_t>(2 * taps + (minified ? 1 : 0))) {}
  constexpr int taps() const { return code_ / 2; }
  constexpr bool minified() const { return code_ % 2 != 0; }
  // Says whether the filter is one tap at the finest level.
  constexpr bool is_plain() const { return *this == SampleFilter(1, false); }
  constexpr std::uint8_t code() const { return code_; }
  constexpr bool operator==(const SampleFilter&) const = default;

 private:
  std::uint8_t code_ = 0;
};

}  // namespace domefall
