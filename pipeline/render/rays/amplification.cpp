#include "pipeline/render/rays/amplification.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

// 1 - cos x without cancellation.
double versine(double x) {
  const double s = std::sin(x / 2);
  return 2 * s * s;
}

// Mean of |sin| over [x - h, x + h].
double mean_abs_sine(double x, double h) {
  if (h >= pi / 2) {  // the integral from 0: 2 for each whole arch
    const auto integral = [](double t) {
      const double arches = std::floor(t / pi);
      return 2 * arches + versine(t - arches * pi);
    };
    return (integral(x + h) - integral(x - h)) / (2 * h);
  }
  const double off = std::abs(std::remainder(x, pi));  // from the nearest zero
  if (off >= h) return std::sin(off) * std::sin(h) / h;
  return (versine(h + off) + versine(h - off)) / (2 * h);
}

}  // namespace

double amplification(const RayBundle& b, double width) {
  const double half = b.doppler * width / 2;
  return mean_abs_sine(b.angle, half) /
         (mean_abs_sine(b.azimuth, b.slope * half) * b.slope * b.doppler * b.doppler);
}

}  // namespace domefall
