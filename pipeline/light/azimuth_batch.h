// Finds the azimuths that many rays sweep.  Each ray reads its own from one of three tabulated
// curves.
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/light/octave_curve.h"

namespace domefall {

// An AzimuthBatch holds many rays: the curve that each belongs to, its coordinate on the curve, and
// what the curve gives there.
struct AzimuthBatch {
  static constexpr int kSize = 128, kCurves = 3;
  template <class T>
  using Column = std::array<T, kSize>;
  alignas(64) Column<std::int64_t> curve;  // 0 to kCurves - 1
  alignas(64) Column<double> x;
  alignas(64) Column<double> azimuth, slope;  // radians, and the derivative by x
};

// Sets azimuth and slope of the first `count` rays by SIMD code.  An x outside its curve counts as
// the nearer end of the curve.  All three curves must exist, even if no ray belongs to one of them.
// The azimuth equals OctaveCurve::value to the last bit, and the slope differs from OctaveCurve::at
// by less than a relative 1e-13.  The tests show both.  Columns up to the next multiple of four are
// written too.
void find_azimuths(const std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves>& curves, int count,
                   AzimuthBatch& batch);

}  // namespace domefall
