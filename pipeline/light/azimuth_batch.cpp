#include "pipeline/light/azimuth_batch.h"

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/transpose_quads.h"

namespace domefall {
namespace {

constexpr int kTerms = OctaveCurve::kTerms;
using Curves = std::array<OctaveCurve::Lookup, AzimuthBatch::kCurves>;

// Polynomials holds, for each ray of a batch, where the coefficients of its polynomial stand in
// memory, its position u in the interval, du/dx, and the coefficients by power.
struct Polynomials {
  alignas(64) AzimuthBatch::Column<const double*> row;
  alignas(64) AzimuthBatch::Column<double> u, inverse_width;
  alignas(64) std::array<AzimuthBatch::Column<double>, kTerms> coefficient;
};

// Finds the polynomial of each ray.  The curve is one of three copies, chosen by selections rather
// than by an index, so that the loop becomes SIMD code.
[[gnu::always_inline]] inline void locate_loop(const Curves& curves, int count,
                                               const AzimuthBatch& __restrict in,
                                               Polynomials& __restrict out) {
  const OctaveCurve::Lookup a = curves[0], b = curves[1], c = curves[2];
  for (int k = 0; k < count; ++k) {
    const OctaveCurve::Lookup curve = in.curve[k] == 0 ? a : in.curve[k] == 1 ? b : c;
    const OctaveCurve::Lookup::Index index = curve(in.x[k]);
    out.row[k] = index.coefficients;
    out.u[k] = index.u;
    out.inverse_width[k] = index.inverse_width;
  }
}
Dispatched<locate_loop> locate_pieces;

// Copies the coefficients of each ray, which fill a whole cache line, into columns.
[[gnu::always_inline]] inline void fetch_loop(int count, Polynomials& polynomials) {
  transpose_rows(polynomials.row, count, polynomials.coefficient);
}
Dispatched<fetch_loop> fetch;

// Evaluates each polynomial and its derivative by Horner's scheme.
[[gnu::always_inline]] inline void evaluate_loop(const Polynomials& __restrict in, int count,
                                                 AzimuthBatch& __restrict out) {
  for (int k = 0; k < count; ++k) {
    const double u = in.u[k];
    double value = in.coefficient[kTerms - 1][k], slope = 0;
    for (int j = kTerms - 2; j >= 0; --j) {
      slope = slope * u + value;
      value = value * u + in.coefficient[j][k];
    }
    out.azimuth[k] = value;
    out.slope[k] = slope * in.inverse_width[k];
  }
}
Dispatched<evaluate_loop> evaluate;

}  // namespace

void find_azimuths(const Curves& curves, int count, AzimuthBatch& batch) {
  const int whole = (count + 3) / 4 * 4;  // rows are transposed by fours
  for (int k = count; k < whole; ++k) {
    batch.curve[k] = 0;
    batch.x[k] = 0;
  }
  Polynomials polynomials;
  locate_pieces(curves, whole, batch, polynomials);
  fetch(whole, polynomials);
  evaluate(polynomials, whole, batch);
}

}  // namespace domefall
