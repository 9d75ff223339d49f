#include "pipeline/show/rate_law.h"

#include <cmath>

#include "pipeline/show/curve.h"

namespace domefall {
namespace {

// The integral from 0 to x of the rate a + (b - a) (3 t^2 - 2 t^3).
double ramp(double a, double b, double x) { return x * (a + (b - a) * x * x * (1 - x / 2)); }

// The integral from 0 to x of (1 - t)^n (1 + n t), which falls from 1 to 0 with a slope of 0 at
// both ends, and is 1 - 3 t^2 + 2 t^3 for n = 2.
double falling(double n, double x) {
  const double exponent = (n + 1) * std::log1p(-x);
  return (-2 * std::expm1(exponent) - n * x * std::exp(exponent)) / (n + 2);
}

// The integral from 0 to x of the same run backwards, t^n (1 + n (1 - t)).
double rising(double n, double x) { return std::pow(x, n + 1) * (2 + n * (1 - x)) / (n + 2); }

}  // namespace

double part_passed(double begin, double end, double x) {
  constexpr double kRounding = 1e-13;
  const double sum = begin + end, missing = 1 - sum / 2;
  if (std::abs(missing) < kRounding) return ramp(begin, end, x);
  if (missing > 0) return ramp(begin, end, x) + missing * smooth_step(x);
  // The integrals of the falling and of the rising rate are 2/(n + 2) each.
  constexpr double kMiddle = 0.5;
  const double n = 2 * (sum - 2 * kMiddle) / (1 - kMiddle) - 2;
  return kMiddle * x + (begin - kMiddle) * falling(n, x) + (end - kMiddle) * rising(n, x);
}

}  // namespace domefall
