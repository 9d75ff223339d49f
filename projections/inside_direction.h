// This file finds the directions of pixels, for loops over many.  The formulas have neither a
// branch nor a library function, so that they become SIMD code where they are called.  The tests
// compare them with direction_at.
#pragma once

#include <array>
#include <numbers>

#include "projections/projection.h"

namespace domefall {

// These are the coefficients of sin(h)/h and cos(h) in t = h^2.
struct HalfAngleSeries {
  static constexpr int kTerms = 9;
  std::array<double, kTerms> sine, cosine;
};
inline constexpr HalfAngleSeries kHalfAngleSeries = [] {
  HalfAngleSeries series{};
  double sine = 1, cosine = 1;
  for (int n = 0; n < HalfAngleSeries::kTerms; ++n) {
    series.sine[n] = sine, series.cosine[n] = cosine;
    const int k = 2 * n + 2;
    cosine /= -(k - 1) * k, sine /= -k * (k + 1);
  }
  return series;
}();

// x and y are pixels from the middle of the image.

// A DomemasterView finds its sines by half of theta, whose series is as good as that of theta with
// twice as many terms.  The next term is below 3e-18 up to theta = pi/2, and below 3e-15 up to
// theta = 0.75 pi.
struct DomemasterView {
  double scale;  // radians per pixel

  explicit DomemasterView(const Domemaster& d) : scale(std::numbers::pi / d.size) {}
  CameraDirection direction(double x, double y) const {
    const double t = (x * x + y * y) * (scale * scale / 4);
    constexpr int kLast = HalfAngleSeries::kTerms - 1;
    double sine = kHalfAngleSeries.sine[kLast], cosine = kHalfAngleSeries.cosine[kLast];
    for (int n = kLast - 1; n >= 0; --n) {
      sine = sine * t + kHalfAngleSeries.sine[n];
      cosine = cosine * t + kHalfAngleSeries.cosine[n];
    }
    const double k = sine * cosine * scale;  // sin(theta)/theta
    return {{x * k, y * k, 1 - 2 * t * (sine * sine)}};
  }
  double pixel_angle(double, double) const { return scale; }
};

// N = -Z + 2 W/|W|^2 with W = Z + w is written so that nothing cancels near the middle.
struct StereographicView {
  double scale;  // tan(theta/2) per pixel: the paper's 2 tan(alpha/2)/C

  explicit StereographicView(const Stereographic& s);
  CameraDirection direction(double x, double y) const {
    const double u = x * scale, v = y * scale, w2 = u * u + v * v, inverse = 1 / (1 + w2);
    return {{2 * u * inverse, 2 * v * inverse, (1 - w2) * inverse}};
  }
  // The projection is conformal, so this is the same in every direction.
  double pixel_angle(double x, double y) const {
    return 2 * scale / (1 + (x * x + y * y) * scale * scale);
  }
};

}  // namespace domefall
