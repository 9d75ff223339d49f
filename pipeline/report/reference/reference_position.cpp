#include "pipeline/report/reference/reference_position.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace domefall {
namespace {

using Digits50 = boost::multiprecision::cpp_bin_float_50;

constexpr int kTaylorOrder = 32;
using TaylorSeries = std::array<Digits50, kTaylorOrder + 1>;

// Returns the Taylor series of w in psi.  Put into w'' = 3 w^2 - w, it gives the recurrence
// (n + 1)(n + 2) a_(n+2) = 3 sum a_k a_(n-k) - a_n.
TaylorSeries orbit_series(const Digits50& w, const Digits50& slope) {
  TaylorSeries a{w, slope};
  for (int n = 0; n + 2 <= kTaylorOrder; ++n) {
    Digits50 square = 0;
    for (int k = 0; k <= n; ++k) square += a[k] * a[n - k];
    a[n + 2] = (3 * square - a[n]) / ((n + 1) * (n + 2));
  }
  return a;
}

// Returns the step over which the last two terms are at most 1e-40 of the first, by solving
// |a_n| h^n = 1e-40 |a_0| for h.  Two terms are asked, because one of them may be small by chance.
double step_of(const TaylorSeries& a) {
  const double size = std::log(static_cast<double>(abs(a[0])));
  const auto allowed = [&](int n) {
    const double term = static_cast<double>(abs(a[n]));
    return term > 0 ? std::exp((size - 40 * std::log(10.0) - std::log(term)) / n) : 1.0;
  };
  return std::min(allowed(kTaylorOrder), allowed(kTaylorOrder - 1));
}

// Returns the sum of the series at h, by Horner's scheme.
Digits50 sum_at(const TaylorSeries& a, const Digits50& h) {
  Digits50 sum = a[kTaylorOrder];
  for (int n = kTaylorOrder - 1; n >= 0; --n) sum = sum * h + a[n];
  return sum;
}

// Returns the series of the derivative.  Its last term, which would need one more term of a, is 0.
TaylorSeries derivative(const TaylorSeries& a) {
  TaylorSeries d{};
  for (int n = 0; n < kTaylorOrder; ++n) d[n] = (n + 1) * a[n + 1];
  return d;
}

// Returns the series q of 1/a.  The product of both is 1, so sum a_k q_(n-k) = 0 for n > 0.
TaylorSeries reciprocal(const TaylorSeries& a) {
  TaylorSeries q{1 / a[0]};
  for (int n = 1; n <= kTaylorOrder; ++n) {
    Digits50 sum = 0;
    for (int k = 1; k <= n; ++k) sum += a[k] * q[n - k];
    q[n] = -sum / a[0];
  }
  return q;
}

Digits50 star(const Digits50& r) { return r + 2 * log(abs(r / 2 - 1)); }

// With e = E/L the metric gives dv/dpsi = -1/(e - w') and du/dpsi = -1/(e + w'), back in time.  A
// Clock counts the one that is regular here: its denominator is a sum of two terms of one sign.
struct Clock {
  bool counts_v;
  TaylorSeries rate;  // of -v or -u
};

// Returns the clock for the place where the orbit has these slopes.  For e w' <= 0 the terms of
// e - w' have one sign, and otherwise those of e + w'.
Clock clock_at(const Digits50& e, const TaylorSeries& slope) {
  const bool counts_v = e * slope[0] <= 0;
  TaylorSeries off{};
  for (int n = 0; n <= kTaylorOrder; ++n) off[n] = counts_v ? Digits50(-slope[n]) : slope[n];
  off[0] += e;
  return {counts_v, reciprocal(off)};
}

}  // namespace

ReferenceRayPlace reference_position(const ReferenceRequest& q, double psi) {
  const ReferenceInvariants k = reference_invariants(q);
  const bool wants_v =
      q.observer != ReferenceObserver::kOutgoing && q.observer != ReferenceObserver::kFour;
  const Digits50 e(k.energy / k.angular_momentum);
  Digits50 w(1 / q.r), slope(k.radial / k.angular_momentum), time = 0;
  for (double left = psi; left > 0;) {
    const TaylorSeries orbit = orbit_series(w, slope), slopes = derivative(orbit);
    const Clock clock = clock_at(e, slopes);
    const double h = std::min({left, step_of(orbit), step_of(clock.rate)});
    const Digits50 star_before = clock.counts_v == wants_v ? Digits50(0) : star(1 / w);
    w = sum_at(orbit, h);
    slope = sum_at(slopes, h);
    // The integral of a series has the terms rate_n h^(n+1)/(n + 1).
    TaylorSeries passed{};
    for (int n = 0; n < kTaylorOrder; ++n) passed[n + 1] = clock.rate[n] / (n + 1);
    time -= sum_at(passed, h);
    // v = u + 2 r* turns the passing of one coordinate into that of the other.
    if (clock.counts_v != wants_v) time += (wants_v ? 2 : -2) * (star(1 / w) - star_before);
    left -= h;
  }
  return {static_cast<double>(1 / w), static_cast<double>(time)};
}

}  // namespace domefall
