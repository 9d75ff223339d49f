// The azimuths of many rays at once, each from one of a few curves.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/optics/octave_curve.h"

namespace domefall {

// On which curves rays lie, where, and what is found there.
struct AzimuthBatch {
  static constexpr int kSize = 128, kCurves = 3;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<std::int64_t> curve;
  alignas(64) Column<double> x;
  alignas(64) Column<double> value, slope;  // and the derivative by x
};

// OctaveCurve's values and slopes, to the last bits, as SIMD code.  Every curve must be one, even if no ray
// lies on it.
void look_up(const std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves>& curves, int count,
             AzimuthBatch& sweeps);

}  // namespace domefall
