#pragma once

#include "projections/equidistant.h"

namespace domefall {

// A Domemaster is an equidistant azimuthal fisheye of a half sphere in a square of `size` pixels
// ([Riazuelo] eq. pix_i_geode, pix_j_geode).  Z is the dome's zenith (its axis), the bottom edge is
// the audience's front, and the right edge its right hand.  It is valid outside the incircle too,
// up to theta = pi.
struct Domemaster {
  static constexpr ProjectionTraits kTraits{
      .name = "domemaster",
      .has_zenith = true,
      .is_dome = true,
      .half_sphere = true,
      .shown_deg = 180,
      .one_number = "a domemaster is square",
      .taker = "a dome",
      .description =
          "Domemaster: equidistant azimuthal fisheye of 180 degrees. The circle\n"
          "touches the edges of the square; the corners are black.",
      .orientation = kDomeOrientation};
  int size = 4096;  // pixels, > 0

  int width() const { return size; }
  int height() const { return size; }
  Domemaster with_sides(int columns, int rows) const { return {std::min(columns, rows)}; }

  double scale() const { return std::numbers::pi / size; }
  double largest_pixel_angle() const { return scale(); }
  CameraDirection direction(Centred at) const { return equidistant_direction(scale(), at); }
  std::optional<Centred> place(const CameraDirection& n) const {
    return equidistant_place(size / std::numbers::pi, n);
  }
  AngularScales scales(Centred at) const { return equidistant_scales(scale(), at); }
  double solid_angle(Centred at) const {
    return scale() * scale() * sinc(std::hypot(at.x, at.y) * scale());
  }
  double scale_change(const CameraDirection& n) const { return equidistant_scale_change(n); }
  CapBox cap_box(const CameraDirection& n, double angle) const {
    return equidistant_cap_box(scale(), n, angle);
  }
  CapSpans cap_spans(const CapPlace& cap, PixelPosition origin, int row,
                     const ColumnRange& inside) const {
    return equidistant_cap_spans(scale(), cap, origin, row, inside);
  }
  bool has_slanted_areas(int) const { return false; }

  struct View;
  View view() const;
};

// Has the coefficients of sin(h)/h and cos(h) in t = h^2.
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

// Sines are found by half of theta, whose series is as good as that of theta with twice as many
// terms.  The next term is below 3e-18 up to theta = pi/2, and below 3e-15 up to theta = 0.75 pi.
struct Domemaster::View {
  double scale;

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
  double area(const CameraDirection& n, double x, double y) const {
    return equidistant_area(scale, n, x, y);
  }
};
inline Domemaster::View Domemaster::view() const { return {scale()}; }

}  // namespace domefall
