#include "pipeline/show/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "trajectories/monotone_cubic.h"

namespace domefall {
namespace {

using Keys = std::vector<CurveKey>;

double secant(const Keys& keys, std::size_t k) {
  return (keys[k].value - keys[k - 1].value) / (keys[k].at_s - keys[k - 1].at_s);
}

// A clock that goes from standstill to full speed, or back, has twice the mean speed at its fast
// end.  These are the slopes of eased() at both ends.
double first_slope(Ease ease) {
  return ease == Ease::kLinear ? 1 : ease == Ease::kEasedOut ? 2 : 0;
}
double last_slope(Ease ease) { return ease == Ease::kLinear ? 1 : ease == Ease::kEasedIn ? 2 : 0; }

// Returns the curve's slope at key k, as value_at describes it.
double slope_at(const Keys& keys, std::size_t k) {
  if (k == 0 || k + 1 == keys.size()) return 0;
  const Ease before = keys[k].ease, after = keys[k + 1].ease;
  if (before == Ease::kHold || after == Ease::kHold) return 0;
  const double in = secant(keys, k), out = secant(keys, k + 1);
  if (before != Ease::kSmooth) return in * last_slope(before);
  if (after != Ease::kSmooth) return out * first_slope(after);
  return monotone_slope(keys[k].at_s - keys[k - 1].at_s, in, keys[k + 1].at_s - keys[k].at_s, out);
}

// Returns the slope at an end of a stretch whose secant is `chord`.  The slope of a linear
// neighbour could carry the cubic beyond its ends.  It is cut to three secants, with which the
// cubic is still monotone (Fritsch and Carlson 1980).
double tamed(double slope, double chord) {
  if (!(slope * chord > 0)) return 0;
  return std::abs(slope) > 3 * std::abs(chord) ? 3 * chord : slope;
}

// ---- the rate of a clock ----

// Returns the integral from 0 to x of the rate a + (b - a) (3 t^2 - 2 t^3).
double ramp(double a, double b, double x) { return x * (a + (b - a) * x * x * (1 - x / 2)); }

// Returns the integral from 0 to x of (1 - t)^n (1 + n t).  This rate falls from 1 to 0 with a
// slope of 0 at both ends, and is 1 - 3 t^2 + 2 t^3 for n = 2.  With U = 1 - x the integral is
// (2 - U^(n+1) (2 + n x))/(n + 2), whose difference cancels for small x unless it is formed by
// expm1 and log1p.
double falling(double n, double x) {
  const double exponent = (n + 1) * std::log1p(-x);
  return (-2 * std::expm1(exponent) - n * x * std::exp(exponent)) / (n + 2);
}

// Returns the integral from 0 to x of the same rate run backwards, t^n (1 + n (1 - t)).
double rising(double n, double x) { return std::pow(x, n + 1) * (2 + n * (1 - x)) / (n + 2); }

}  // namespace

double value_at(const Curve& curve, double t) {
  const Keys& keys = curve.keys;
  const auto next = std::upper_bound(keys.begin(), keys.end(), t,
                                     [](double at, const CurveKey& key) { return at < key.at_s; });
  if (next == keys.begin()) return keys.front().value;
  if (next == keys.end()) return keys.back().value;
  const auto k = static_cast<std::size_t>(next - keys.begin());
  const CurveKey &from = keys[k - 1], &to = keys[k];
  const double h = to.at_s - from.at_s, x = (t - from.at_s) / h;
  if (to.ease != Ease::kSmooth) return from.value + eased(to.ease, x) * (to.value - from.value);
  const double chord = secant(keys, k);
  return HermiteCubic(from.value, to.value, tamed(slope_at(keys, k - 1), chord) * h,
                      tamed(slope_at(keys, k), chord) * h)
      .at(x);
}

double eased(Ease ease, double x) {
  switch (ease) {
    case Ease::kSmooth:
    case Ease::kEased:
      return smooth_step(x);
    case Ease::kLinear:
      return x;
    case Ease::kHold:
      return 0;
    case Ease::kEasedIn:
      return part_passed(0, 2, x);
    case Ease::kEasedOut:
      return part_passed(2, 0, x);
  }
  return x;
}

double largest(const Curve& curve) {
  return std::ranges::max_element(curve.keys, {}, &CurveKey::value)->value;
}

double smooth_step(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

double light_left(const Fades& fades, double begin, double end, double t) {
  const auto part = [](double passed, double fade) {
    return fade > 0 ? smooth_step(passed / fade) : 1;
  };
  const double left = part(t - begin, fades.in_s) * part(end - t, fades.out_s);
  return left * left;
}

double part_passed(double begin, double end, double x) {
  constexpr double kRounding = 1e-13;
  const double sum = begin + end, missing = 1 - sum / 2;
  if (std::abs(missing) < kRounding) return ramp(begin, end, x);
  if (missing > 0) return ramp(begin, end, x) + missing * smooth_step(x);
  // The integrals of the falling and of the rising rate over the whole segment are 2/(n + 2) each.
  // The mean kMiddle + (sum - 2 kMiddle) 2/(n + 2) must be 1, which gives n.
  constexpr double kMiddle = 0.5;
  const double n = 2 * (sum - 2 * kMiddle) / (1 - kMiddle) - 2;
  return kMiddle * x + (begin - kMiddle) * falling(n, x) + (end - kMiddle) * rising(n, x);
}

}  // namespace domefall
