#include "pipeline/show/curve.h"

#include <algorithm>
#include <cstddef>

namespace domefall {
namespace {

using Keys = std::vector<CurveKey>;

// Returns the mean slope of the stretch that ends at key k.
double secant(const Keys& keys, std::size_t k) {
  return (keys[k].value - keys[k - 1].value) / (keys[k].at_s - keys[k - 1].at_s);
}

// Returns the curve's slope at key k, as value_at describes it.
double slope_at(const Keys& keys, std::size_t k) {
  if (k == 0 || k + 1 == keys.size()) return 0;
  const Ease before = keys[k].ease, after = keys[k + 1].ease;
  if (before == Ease::kHold || after == Ease::kHold) return 0;
  const double in = secant(keys, k), out = secant(keys, k + 1);
  if (before == Ease::kLinear) return in;
  if (after == Ease::kLinear) return out;
  if (!(in * out > 0)) return 0;
  // The weights of the harmonic mean favour the secant of the shorter stretch.
  const double h_in = keys[k].at_s - keys[k - 1].at_s, h_out = keys[k + 1].at_s - keys[k].at_s;
  const double a = 2 * h_out + h_in, b = h_out + 2 * h_in;
  return (a + b) / (a / in + b / out);
}

// Returns the slope at an end of a stretch whose secant is `chord`.  The slope of a linear
// neighbour could carry the cubic beyond its ends.  It is cut to three secants, with which the
// cubic is still monotone (Fritsch and Carlson 1980).
double tamed(double slope, double chord) {
  if (!(slope * chord > 0)) return 0;
  return std::abs(slope) > 3 * std::abs(chord) ? 3 * chord : slope;
}

}  // namespace

double value_at(const Curve& curve, double t) {
  const Keys& keys = curve.keys;
  const auto next = std::upper_bound(keys.begin(), keys.end(), t,
                                     [](double at, const CurveKey& key) { return at < key.at_s; });
  if (next == keys.begin()) return keys.front().value;
  if (next == keys.end()) return keys.back().value;
  const auto k = static_cast<std::size_t>(next - keys.begin());
  const CurveKey &from = keys[k - 1], &to = keys[k];
  if (to.ease == Ease::kHold) return from.value;
  const double h = to.at_s - from.at_s, x = (t - from.at_s) / h;
  if (to.ease == Ease::kLinear) return from.value + x * (to.value - from.value);
  // This is the cubic Hermite polynomial in x, in Horner's form, with the slopes m0 and m1 per unit
  // of x at the ends.  Its coefficients follow from the values and the slopes at x = 0 and x = 1.
  const double chord = secant(keys, k);
  const double m0 = tamed(slope_at(keys, k - 1), chord) * h,
               m1 = tamed(slope_at(keys, k), chord) * h;
  const double rise = to.value - from.value;
  return from.value + x * (m0 + x * (3 * rise - 2 * m0 - m1 + x * (m0 + m1 - 2 * rise)));
}

double largest(const Curve& curve) {
  return std::max_element(curve.keys.begin(), curve.keys.end(),
                          [](const CurveKey& a, const CurveKey& b) { return a.value < b.value; })
      ->value;
}

double smooth_step(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

}  // namespace domefall
