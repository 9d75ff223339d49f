#include "pipeline/light/spherical_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/base/simd/dispatch.h"
#include "pipeline/base/simd/transpose_quads.h"
#include "pipeline/base/simd/vector_math.h"
#include "pipeline/light/einstein_rings.h"
#include "pipeline/light/half_angle.h"
#include "pipeline/light/hole_optics.h"

namespace domefall {
namespace {

// The curve of each pair of orders has this number of intervals.  From order 2 on all images are
// near the edge, where fewer intervals are as accurate.
constexpr int kIntervals = 512, kIntervalsBesideEdge = 64;
// So many pairs have curves at least.  In a long cylinder or a wide throat the images of many more
// are hardly fainter than the first, and those down to kFaint of its light have curves, too.  Where
// the first are brighter than their sources, as at an inner horizon, that is kFaint of the sources'.
constexpr int kPairs = 4, kMostPairs = 256;
constexpr double kFaint = 1e-8;

// Returns 1 for even orders, whose images are on the source's side of the hole, and -1 for odd ones.
double side_of(int order) { return order % 2 == 0 ? 1 : -1; }

// Fills the columns sine and v.  Let c and s be the cosine and the sine of half the angle from +R.
// With t = tan(angle/4) = s/(1 + c), the addition theorem makes v = tan(pi/4 - angle/4) equal to
// (1 - t)/(1 + t) = (1 + c - s)/(1 + c + s).
[[gnu::always_inline]] inline void to_lens_loop(int count, PointBatch& sources) {
  for (int k = 0; k < count; ++k) {
    const double x = sources.x[k], y = sources.y[k], z = sources.z[k];
    const double sine = std::sqrt(y * y + z * z);
    const HalfAngle half = half_angle(x, sine);
    sources.sine[k] = sine;
    sources.v[k] = (1 + half.cosine - half.sine) / (1 + half.cosine + half.sine);
  }
}
Dispatched<to_lens_loop> to_lens;

// Cubics hold where the cubics of a batch of v stand in the table, and their coefficients by power.
struct Cubics {
  alignas(64) PointBatch::Column<const double*> row;
  alignas(64) PointBatch::Column<double> v, share;
  alignas(64) std::array<PointBatch::Column<double>, LensCurve::kTerms> coefficient;
};

[[gnu::always_inline]] inline void look_up_loop(const LensCurve::Lookup& lookup, double side,
                                                const double* v, int count, double* __restrict psi,
                                                double* __restrict slope) {
  const LensCurve::Lookup curve = lookup;
  Cubics cubics;
  for (int k = 0; k < count; ++k) {
    cubics.v[k] = side * v[k];
    const LensCurve::Lookup::Index at = curve(cubics.v[k]);
    cubics.row[k] = at.coefficients;
    cubics.share[k] = at.share;
  }
  const int whole = (count + 3) / 4 * 4;  // rows are fetched by fours
  for (int k = count; k < whole; ++k) cubics.row[k] = curve.coefficients;
  transpose_rows(cubics.row, whole, cubics.coefficient);
  const auto& c = cubics.coefficient;
  for (int k = 0; k < count; ++k) {
    const LensCurve::View view =
        curve.view(cubics.v[k], cubics.share[k], c[0][k], c[1][k], c[2][k], c[3][k]);
    psi[k] = view.psi;
    slope[k] = view.slope;
  }
}
Dispatched<look_up_loop> look_up;

// Makes images at the angles psi from the sky's far end.  An image lies in the plane of R and its
// source.  Its amplification is |sin psi d psi/(sin phi d phi)|.
[[gnu::always_inline]] inline void bend_all_loop(const PsiFrame& frame, double side,
                                                 const double* __restrict psis,
                                                 const double* __restrict slopes,
                                                 const PointBatch& __restrict sources, int count,
                                                 PointImageBatch& __restrict images) {
  const PsiFrame psi = frame;
  for (int k = 0; k < count; ++k) {
    const SineCosine half = sin_cos(0.5 * psis[k]);
    const double s2 = half.sine * half.sine, c2 = half.cosine * half.cosine;
    const double energy = psi.energy.one_plus_z(psi.energy.sine2 * s2 + psi.energy.cosine2 * c2);
    const double across = 2 * half.sine * half.cosine / sources.sine[k];
    images.x[k] = psi.outward * (c2 - s2);
    images.y[k] = sources.y[k] * (side * across);
    images.z[k] = sources.z[k] * (side * across);
    images.frequency_ratio[k] = 1 / energy;
    images.amplification[k] = across * slopes[k];
  }
}
Dispatched<bend_all_loop> bend_all;

}  // namespace

SphericalPoints::SphericalPoints(std::vector<const SkyTable*> tables,
                                 const std::optional<PointTolerance>& tolerance)
    : tables_(std::move(tables)) {
  for (const SkyTable* table : tables_) psi_.push_back(psi_frame(*table));
  if (!tolerance) return;
  const auto each = static_cast<int>(tables_.size());
  const auto add_pair = [&](int pair, int intervals) {
    for (const SkyTable* table : tables_) curves_.emplace_back(*table, pair, intervals, *tolerance);
  };
  const auto brings = [&](int pair) {
    double most = 0;
    for (int k = 0; k < 2 * each; ++k) most = std::max(most, most_light(2 * pair * each + k));
    return most;
  };
  add_pair(0, kIntervals);
  const double faint = kFaint * std::min(1.0, brings(0));
  for (int pair = 1; pair < kPairs || (pair < kMostPairs && brings(pair) > faint); ++pair)
    add_pair(pair, kIntervalsBesideEdge);
}

SkyImage SphericalPoints::image(const V3d& source, int order, double blur) const {
  return image_of(tables_[table_of(order)], source, order_in_table(order), blur);
}

std::vector<SkyImage> SphericalPoints::arc(const V3d& source, int order, double radius,
                                           const std::function<double(const V3d&)>& spacing) const {
  return arc_of(*tables_[table_of(order)], source, order_in_table(order), radius, spacing);
}

double SphericalPoints::most_light(int order) const {
  return order < orders_in_batches()
             ? curves_[static_cast<std::size_t>(order / 2)].largest_bound(order % 2 != 0)
             : most_light_from(*tables_[table_of(order)], order_in_table(order));
}

void SphericalPoints::locate(PointBatch& points, int count) const { to_lens(count, points); }

void SphericalPoints::bounds(int order, const PointBatch& points, const int* chosen, int count,
                             float* out) const {
  const LensCurve& curve = curves_[static_cast<std::size_t>(order / 2)];
  const float* bounds = curve.bounds();
  const double side = side_of(order);
  for (int n = 0; n < count; ++n)
    out[n] = bounds[curve.interval_of(side * points.v[static_cast<std::size_t>(chosen[n])])];
}

void SphericalPoints::images(int order, const PointBatch& points, int count,
                             PointImageBatch& images) const {
  PointBatch::Column<double> psi, slope;
  const LensCurve& curve = curves_[static_cast<std::size_t>(order / 2)];
  look_up(curve.lookup(), side_of(order), points.v.data(), count, psi.data(), slope.data());
  bend_all(psi_[table_of(order)], side_of(order), psi.data(), slope.data(), points, count, images);
}

}  // namespace domefall
