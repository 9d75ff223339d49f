#include "pipeline/render/sweeps.h"

#include <cstring>

#include "pipeline/render/simd.h"

namespace domefall {
namespace {

constexpr int kTerms = OctaveCurve::kTerms;

struct Spots {
  alignas(64) Sweeps::Column<std::int64_t> interval;
  alignas(64) Sweeps::Column<double> u, inverse_width;
  alignas(64) std::array<Sweeps::Column<double>, kTerms> coefficient;
};

[[gnu::always_inline]] inline void locate_loop(
    const std::array<OctaveCurve::Lookup, Sweeps::kCurves>& curves, int count,
    const Sweeps& __restrict in, Spots& __restrict out) {
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

using Quad __attribute__((vector_size(32))) = double;

// Four coefficients of four rays each become four rays' coefficients.  `at`: the rays' first.
[[gnu::always_inline]] inline void turn(const double* const* at, std::ptrdiff_t first, int ray,
                                        Spots& out) {
  Quad a, b, c, d;
  std::memcpy(&a, at[0] + first, sizeof a);
  std::memcpy(&b, at[1] + first, sizeof b);
  std::memcpy(&c, at[2] + first, sizeof c);
  std::memcpy(&d, at[3] + first, sizeof d);
  const Quad even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Quad odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Quad even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Quad odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Quad turned[4] = {__builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5),
                          __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
                          __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7),
                          __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7)};
  for (int j = 0; j < 4; ++j)
    std::memcpy(&out.coefficient[first + j][ray], &turned[j], sizeof turned[j]);
}

// Whole lines of the cache for each ray, instead of gathering numbers from them.
[[gnu::always_inline]] inline void fetch_loop(
    const std::array<const double*, Sweeps::kCurves>& coefficients, int count, const Sweeps& in,
    Spots& spots) {
  for (int k = 0; k < count; k += 4) {
    const double* at[4];
    for (int m = 0; m < 4; ++m)
      at[m] = coefficients[in.curve[k + m]] + kTerms * spots.interval[k + m];
    turn(at, 0, k, spots), turn(at, 4, k, spots);
  }
}
Dispatched<fetch_loop> fetch;

[[gnu::always_inline]] inline void evaluate_loop(const Spots& __restrict in, int count,
                                                 Sweeps& __restrict out) {
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

void look_up(const std::array<OctaveCurve::Lookup, Sweeps::kCurves>& curves, int count,
             Sweeps& sweeps) {
  // Four at a time.
  const int whole = (count + 3) / 4 * 4;
  for (int k = count; k < whole; ++k) sweeps.curve[k] = 0, sweeps.x[k] = 0;
  Spots spots;
  locate(curves, whole, sweeps, spots);
  fetch({curves[0].coefficients(), curves[1].coefficients(), curves[2].coefficients()}, whole,
        sweeps, spots);
  evaluate(spots, whole, sweeps);
}

}  // namespace domefall
