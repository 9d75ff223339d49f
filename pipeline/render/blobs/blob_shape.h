// A BlobShape is the shape of a star's blob in pixels.  A Gaussian that is round in angle is, to
// first order about its centre, an ellipse in pixels, which the square of each pixel blurs.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/scene/point_spread.h"
#include "projections/projection.h"

namespace domefall {

// At an offset d (pixels) from the centre the blob's weight is W = exp(-q) with q = d P d / 2,
// where the symmetric matrix P is the inverse of the covariance.
struct BlobShape {
  double xx, xy, yy;                 // P with the pixel's blur, 1 / pixel^2
  double spread_x, spread_y;         // variances along x and y with the pixel's blur, pixel^2
  double flattening;                 // f of FlattenedGaussian
  double solid_angle;                // integral of W over the sphere, sr
  double bare_xx, bare_xy, bare_yy;  // P without the pixel's blur
  double scale_change;  // an upper bound of the relative change of the image's scale within a sigma
};

// The first order errs by at most 0.6 scale_change of the peak.  Up to this scale_change the error
// is at most 1.2e-3.
inline constexpr double kMostScaleChange = 0.002;

// A FlattenedGaussian is the mean of a Gaussian over the square of a pixel.  Along each axis the
// square adds a variance of 1/12 pixel^2, which P contains, and a fourth cumulant k = -1/120.  To
// first order the cumulant changes W by k/4! (d^4 W/dx^4 + d^4 W/dy^4).  For a round W, averaged
// over directions, this change is -f (6 - 12 q + 3 q^2) W with f = (xx^2 + yy^2)/5760.  The bracket
// is approximated by 13.5 W - 7.5, which is exact at q = 0, so that the mean is
// W (1 + 7.5 f - 13.5 f W).
//
// The error was measured against the integral over each pixel, in parts of the peak.  It is 5e-4 at
// a sigma of 0.9 pixel and 2e-4 at 1.14.  At a dome's rim, where the ellipse lies along one axis,
// it is 7e-4 and 3e-4.  Without f it is 3e-3.
struct FlattenedGaussian {
  double slope, dent;  // the mean is W (slope - dent W)
  explicit FlattenedGaussian(double flattening)
      : slope(1 + 7.5 * flattening), dent(13.5 * flattening) {}
  double operator()(double w) const { return w * (slope - dent * w); }
};

// Returns the share of the integral of W that is left when a blob ends where W falls to `cut` and
// the value there is subtracted from the whole blob.  The area within a given q is proportional to
// q.  In units in which the integral of W is 1, the light is therefore the integral of
// f(exp(-q)) - f(cut) from q = 0 to -ln(cut).
inline double share_left(const FlattenedGaussian& f, double cut) {
  const double q = -logarithm(cut);
  return f.slope * (1 - cut) - f.dent / 2 * (1 - cut * cut) - q * f(cut);
}

// A BlobScale holds the factor from a blob's flux to its peak value, and its cut.
struct BlobScale {
  double peak_per_flux, cut;
};

// The cut follows from the peak (cut_of), and the peak follows from the share of the light that the
// cut leaves.  One round of this iteration suffices, since a second one would change the share by
// less than 1e-5.
inline BlobScale blob_scale(const BlobShape& shape, double brightest_flux) {
  const FlattenedGaussian f(shape.flattening);
  const double whole = brightest_flux / shape.solid_angle;
  const double first = share_left(f, cut_of(whole));
  const double cut = cut_of(whole / first);
  return {1 / (shape.solid_angle * share_left(f, cut)), cut};
}

// Returns the shape of a blob of width sigma (radians) at (cx, cy), in pixels from the middle of
// the image.  `unit` is the angle per pixel in radians on a dome, where theta must be below 1.9,
// and tan(theta/2) per pixel on a flat image.
//
// On a dome theta is proportional to the distance from the middle, so that a pixel covers `unit`
// along the meridian and unit sinc(theta) along the tangent.  In pixels the variance is therefore
// v = sigma^2/unit^2 along the meridian and across = v/sinc^2 along the tangent.  The covariance is
//     across I - outer c c^T,   outer = (across - v)/|c|^2 = across (1 - sinc)(1 + sinc)/|c|^2.
// With u = (1 - sinc)/theta^2 and theta = unit |c| this becomes outer = across u (1 + sinc) unit^2,
// which does not cancel at the middle.  A flat image is stereographic: a pixel covers
// 2 unit/(1 + t) in all directions, where t = tan^2(theta/2).
template <bool kDome>
inline BlobShape blob_shape(double unit, double cx, double cy, double sigma) {
  const double t = unit * unit * (cx * cx + cy * cy);  // theta^2, or tan^2(theta/2) on a flat image
  double v = 0, across = 0, outer = 0, pixel = 0, scale_change = 0;
  if constexpr (kDome) {
    // u = (1 - sinc theta)/theta^2 = 1/3! - t/5! + t^2/7! - ...; the next term is below 2e-17 at
    // 1.9.
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
    // The scale along the tangent, 1/sinc, has the logarithmic derivative 1/theta - cot theta.
    // This is below 0.41 theta up to theta = 1.6, a little beyond the rim.
    scale_change = 0.41 * std::sqrt(t) * sigma;
  } else {
    const double side = 2 * unit / (1 + t);
    v = sigma * sigma / (side * side);
    across = v;
    pixel = side * side;
    scale_change = std::sqrt(t) * sigma;  // the logarithmic derivative of 1/side is tan(theta/2)
  }
  // The square of the pixel adds its variance along both axes, and P is the inverse of the sum.
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
          scale_change};
}

}  // namespace domefall
