#include "pipeline/render/rays/azimuth_batch.h"

#include "pipeline/simd/dispatch.h"
#include "pipeline/simd/transpose_quads.h"

namespace domefall {
namespace {

constexpr int kTerms = OctaveCurve::kTerms;

struct TexelIndices {
  alignas(64) AzimuthBatch::Column<std::int64_t> interval;
  alignas(64) AzimuthBatch::Column<double> u, inverse_width;
  alignas(64) std::array<AzimuthBatch::Column<double>, kTerms> coefficient;
};

[[gnu::always_inline]] inline void locate_loop(
    const std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves>& curves, int count,
    const AzimuthBatch& __restrict in, TexelIndices& __restrict out) {
  const OctaveCurve::Lookup a = curves[0], b = curves[1], c = curves[2];
  for (int k = 0; k < count; ++k) {
    const OctaveCurve::Lookup of = in.curve[k] == 0 ? a : in.curve[k] == 1 ? b : c;
    const OctaveCurve::Lookup::Spot spot = of(in.x[k]);
    out.interval[k] = spot.interval;
    out.u[k] = spot.u;
    out.inverse_width[k] = spot.inverse_width;
  }
}
Dispatched<locate_loop> locate;

// Whole lines of the cache for each ray, instead of gathering numbers from them.
[[gnu::always_inline]] inline void fetch_loop(
    const std::array<const double*, AzimuthBatch::kCurves>& coefficients, int count,
    const AzimuthBatch& in, TexelIndices& spots) {
  for (int k = 0; k < count; k += 4) {
    const double* at[4];
    for (int m = 0; m < 4; ++m)
      at[m] = coefficients[in.curve[k + m]] + kTerms * spots.interval[k + m];
    for (int first = 0; first < kTerms; first += 4) {
      const double* from[4];
      double* out[4];
      for (int m = 0; m < 4; ++m)
        from[m] = at[m] + first, out[m] = &spots.coefficient[first + m][k];
      turn_quads(from, out);
    }
  }
}
Dispatched<fetch_loop> fetch;

[[gnu::always_inline]] inline void evaluate_loop(const TexelIndices& __restrict in, int count,
                                                 AzimuthBatch& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const double u = in.u[k];
    double value = in.coefficient[kTerms - 1][k], slope = 0;
    for (int j = kTerms - 2; j >= 0; --j) {
      slope = slope * u + value;
      value = value * u + in.coefficient[j][k];
    }
    out.value[k] = value;
    out.slope[k] = slope * in.inverse_width[k];
  }
}
Dispatched<evaluate_loop> evaluate;

}  // namespace

void look_up(const std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves>& curves, int count,
             AzimuthBatch& sweeps) {
  // Four at a time.
  const int whole = (count + 3) / 4 * 4;
  for (int k = count; k < whole; ++k) sweeps.curve[k] = 0, sweeps.x[k] = 0;
  TexelIndices spots;
  locate(curves, whole, sweeps, spots);
  fetch({curves[0].coefficients(), curves[1].coefficients(), curves[2].coefficients()}, whole,
        sweeps, spots);
  evaluate(spots, whole, sweeps);
}

}  // namespace domefall
