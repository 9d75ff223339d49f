#include "pipeline/show/rate_law.h"

#include <cmath>

#include "pipeline/show/curve.h"

namespace domefall {
namespace {

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
