#include "pipeline/light/amplification.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

// Returns 1 - cos x as 2 sin^2(x/2), which does not cancel near x = 0.
double versine(double x) {
  const double s = std::sin(x / 2);
  return 2 * s * s;
}

// Returns the mean of |sin| over [x - h, x + h].  The integral of |sin| is 2 over a whole arch,
// from one zero to the next, and 1 - cos t over the part of an arch from a zero to the distance t.
double mean_abs_sine(double x, double h) {
  if (h >= pi / 2) {
    const auto integral = [](double t) {  // from 0 to t
      const double arches = std::floor(t / pi);
      return 2 * arches + versine(t - arches * pi);
    };
    return (integral(x + h) - integral(x - h)) / (2 * h);
  }
  // An interval without a zero inside has cos(x - h) - cos(x + h) = 2 sin x sin h as its integral.
  // One with a zero has parts of two arches.
  const double off = std::abs(std::remainder(x, pi));  // the distance of x from the nearest zero
  if (off >= h) return std::sin(off) * std::sin(h) / h;
  return (versine(h + off) + versine(h - off)) / (2 * h);
}

// Returns the mean of |area + change t| for t in [-half, half].  Past its zero the area grows again.
double mean_area(const SkyPatch& p, double half) {
  const double most = p.change * half;
  return p.area >= most ? p.area : (p.area * p.area / most + most) / 2;
}

}  // namespace

double amplification(const RayBundle& b, double width) {
  // Angles in the frame of the lens are `doppler` times those in the view.
  const double half = b.doppler * width / 2;
  const auto* about_axis = std::get_if<AxisPatch>(&b.patch);
  if (!about_axis)
    return 1 / (mean_area(std::get<SkyPatch>(b.patch), half) * b.doppler * b.doppler);
  // Azimuths are `slope` times as large as angles.
  const auto& [angle, azimuth, slope] = *about_axis;
  return mean_abs_sine(angle, half) /
         (mean_abs_sine(azimuth, slope * half) * slope * b.doppler * b.doppler);
}

}  // namespace domefall
