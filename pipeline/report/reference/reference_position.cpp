#include "pipeline/report/reference/reference_position.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace domefall {
namespace {

using Digits50 = boost::multiprecision::cpp_bin_float_50;

constexpr int kOrder = 32;
using TaylorSeries = std::array<Digits50, kOrder + 1>;

// (n + 1)(n + 2) a_(n+2) = 3 sum a_k a_(n-k) - a_n.
TaylorSeries orbit_series(const Digits50& w, const Digits50& slope) {
  TaylorSeries a{w, slope};
  for (int n = 0; n + 2 <= kOrder; ++n) {
    Digits50 square = 0;
    for (int k = 0; k <= n; ++k) square += a[k] * a[n - k];
    a[n + 2] = (3 * square - a[n]) / ((n + 1) * (n + 2));
  }
  return a;
}

// The step over which the last terms are 1e-40 of w.
double step_of(const TaylorSeries& a) {
  const double size = std::log(static_cast<double>(a[0]));
  const auto allowed = [&](int n) {
    const double term = static_cast<double>(abs(a[n]));
    return term > 0 ? std::exp((size - 40 * std::log(10.0) - std::log(term)) / n) : 1.0;
  };
  return std::min(allowed(kOrder), allowed(kOrder - 1));
}

}  // namespace

double reference_position(const ReferenceRequest& q, double psi) {
  const ReferenceInvariants k = reference_invariants(q);
  Digits50 w(1 / q.r), slope(k.radial / k.angular_momentum);
  for (double left = psi; left > 0;) {
    const TaylorSeries a = orbit_series(w, slope);
    const double h = std::min(left, step_of(a));
    w = a[kOrder];
    slope = kOrder * a[kOrder];
    for (int n = kOrder - 1; n >= 0; --n) w = w * h + a[n];
    for (int n = kOrder - 1; n >= 1; --n) slope = slope * h + n * a[n];
    left -= h;
  }
  return static_cast<double>(1 / w);
}

}  // namespace domefall
