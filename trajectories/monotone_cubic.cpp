#include "trajectories/monotone_cubic.h"

#include <algorithm>
#include <cmath>

#include "trajectories/zero_between.h"

namespace domefall {
namespace {

// Returns the rate of the first or last key.  It is the parabola's slope, within what keeps the
// cubic from turning.
double end_slope(double span, double own, double next_span, double next) {
  const double slope = ((2 * span + next_span) * own - span * next) / (span + next_span);
  if (slope * own <= 0) return 0;
  if (own * next <= 0 && std::abs(slope) > 3 * std::abs(own)) return 3 * own;
  return slope;
}

std::vector<double> monotone_slopes(const std::vector<double>& taus,
                                    const std::vector<double>& values) {
  const std::size_t n = taus.size();
  std::vector<double> span(n - 1), rise(n - 1), slope(n);
  for (std::size_t k = 0; k + 1 < n; ++k)
    span[k] = taus[k + 1] - taus[k], rise[k] = (values[k + 1] - values[k]) / span[k];
  if (n == 2) return {rise[0], rise[0]};
  slope[0] = end_slope(span[0], rise[0], span[1], rise[1]);
  slope[n - 1] = end_slope(span[n - 2], rise[n - 2], span[n - 3], rise[n - 3]);
  for (std::size_t k = 1; k + 1 < n; ++k)
    slope[k] = monotone_slope(span[k - 1], rise[k - 1], span[k], rise[k]);
  return slope;
}

}  // namespace

std::vector<HermiteCubic> cubics_between(const std::vector<double>& taus,
                                         const std::vector<double>& values,
                                         const std::vector<std::optional<double>>& rates) {
  const std::vector<double> slopes = monotone_slopes(taus, values);
  std::vector<HermiteCubic> cubics;
  for (std::size_t k = 0; k + 1 < taus.size(); ++k) {
    const double span = taus[k + 1] - taus[k];
    cubics.emplace_back(values[k], values[k + 1], rates[k].value_or(slopes[k]) * span,
                        rates[k + 1].value_or(slopes[k + 1]) * span);
  }
  return cubics;
}

std::vector<double> turns_of(const HermiteCubic& c) {
  std::vector<double> cuts{0};
  const double a = 3 * c.c3, b = c.c2, under = b * b - a * c.c1;
  if (under > 0) {
    const double q = -(b + std::copysign(std::sqrt(under), b));
    std::vector<double> found;
    if (a != 0) found.push_back(q / a);
    if (q != 0) found.push_back(c.c1 / q);
    std::sort(found.begin(), found.end());
    for (const double t : found)
      if (t > cuts.back() && t < 1) cuts.push_back(t);
  }
  cuts.push_back(1);
  return cuts;
}

double where(const HermiteCubic& c, double value, double low, double high) {
  return zero_between([&](double t) { return c.at(t) - value; }, low, high);
}

}  // namespace domefall
