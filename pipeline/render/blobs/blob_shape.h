// A star's blob in pixels: a Gaussian round in angle is an ellipse there, blurred by the pixel's square.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/render/scene/point_spread.h"
#include "pipeline/simd/vector_math.h"
#include "projections/projection.h"

namespace domefall {

// About a star, to first order in the offset d (pixels): W = exp(-q), q = d P d / 2.
struct BlobShape {
  double xx, xy, yy;                 // P, 1 / pixel^2
  double spread_x, spread_y;         // variances along x and y, pixel^2
  double flat;                       // see FlatGaussian
  double solid_angle;                // integral of W over the sphere, sr
  double bare_xx, bare_xy, bare_yy;  // P without the pixel's blur
  double bend;  // at most by so much the local scale changes, in parts, within one sigma
};

// The first order is in error by at most 0.6 bend of the peak: 1.2e-3 up to here.
inline constexpr double kMostBend = 0.002;

// A Gaussian over the square of a pixel is a Gaussian with 1/12 pixel^2 more variance along each axis
// but for a fourth cumulant of -1/120, which flattens its top: to a third of that,
// W (1 + 7.5 f - 13.5 f W) with f = (xx^2 + yy^2) / 5760.  Measured, in parts of the peak, against the
// integral over each pixel: 5e-4 at a sigma of 0.9 pixel, 2e-4 at 1.14; at a dome's rim, where the
// ellipse lies along one axis, 7e-4 and 3e-4.  Without f 3e-3.
struct FlatGaussian {
  double slope, dent;  // W (slope - dent W)
  explicit FlatGaussian(double flat) : slope(1 + 7.5 * flat), dent(13.5 * flat) {}
  double operator()(double w) const { return w * (slope - dent * w); }
};

// Integral of a blob so cut over that of W.
inline double share_left(const FlatGaussian& f, double cut) {
  const double q = -logarithm(cut);
  return f.slope * (1 - cut) - f.dent / 2 * (1 - cut * cut) - q * f(cut);
}

// Of a blob: the factor from flux to peak value, and its cut.
struct BlobScale {
  double peak_per_flux, cut;
};

// The cut follows from the peak, the peak from what the cut leaves: one round of that suffices, since
// it changes the share by less than 1e-5.
inline BlobScale blob_scale(const BlobShape& shape, double brightest_flux) {
  const FlatGaussian f(shape.flat);
  const double whole = brightest_flux / shape.solid_angle;
  const double first = share_left(f, cut_of(whole));
  const double cut = cut_of(whole / first);
  return {1 / (shape.solid_angle * share_left(f, cut)), cut};
}

// cx, cy: the star's pixel from the middle of the picture.  unit: radians per pixel on a dome
// (theta < 1.9), tan(theta/2) per pixel on a flat picture.  sigma: radians.
template <bool kDome>
inline BlobShape blob_shape(double unit, double cx, double cy, double sigma) {
  const double t = unit * unit * (cx * cx + cy * cy);
  double v = 0, across = 0, outer = 0, pixel = 0, bend = 0;
  if constexpr (kDome) {
    // (1 - sinc theta) / theta^2 in powers of t = theta^2; the next term is below 1e-14 at 1.9.
    constexpr std::array<double, 10> kSeries{1.0 / 6,
                                             -1.0 / 120,
                                             1.0 / 5040,
                                             -1.0 / 362880,
                                             1.0 / 39916800,
                                             -1.0 / 6227020800,
                                             1.0 / 1307674368000.0,
                                             -1.0 / 355687428096000.0,
                                             1.0 / 121645100408832000.0,
                                             -1.0 / 51090942171709440000.0};
    double u = kSeries[9];
    for (int n = 8; n >= 0; --n) u = u * t + kSeries[static_cast<std::size_t>(n)];
    const double sinc = 1 - t * u;
    v = sigma * sigma / (unit * unit);
    across = v / (sinc * sinc);
    outer = across * u * (1 + sinc) * unit * unit;
    pixel = unit * unit * sinc;
    bend = 0.41 * std::sqrt(t) * sigma;  // 1/theta - cot theta < 0.41 theta
  } else {
    const double side = 2 * unit / (1 + t);
    v = sigma * sigma / (side * side);
    across = v;
    pixel = side * side;
    bend = std::sqrt(t) * sigma;
  }
  const double bare_x = across - outer * cx * cx, bare_y = across - outer * cy * cy;
  const double mixed = -outer * cx * cy;
  const double bare = 1 / (bare_x * bare_y - mixed * mixed);
  const double x = bare_x + 1.0 / 12, y = bare_y + 1.0 / 12;
  const double determinant = x * y - mixed * mixed, inverse = 1 / determinant;
  const double xx = y * inverse, yy = x * inverse;
  return {xx,
          -mixed * inverse,
          yy,
          x,
          y,
          (xx * xx + yy * yy) / 5760,
          2 * std::numbers::pi * std::sqrt(determinant) * pixel,
          bare_y * bare,
          -mixed * bare,
          bare_x * bare,
          bend};
}

}  // namespace domefall
