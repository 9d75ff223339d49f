#pragma once

#include "pipeline/base/simd/vector_math.h"
#include "projections/equidistant.h"

namespace domefall {

// A Fisheye is an equidistant azimuthal fisheye of any opening, for domes of more or less than a
// half sphere.  Its circle is as wide as the image.  An image lower than that is of a truncated
// dome.
struct Fisheye {
  static constexpr ProjectionTraits kTraits{
      .name = "fisheye",
      .has_zenith = true,
      .is_dome = true,
      .usual_deg = 180,
      .widest_deg = 360,
      .one_number = "of a square, or [width, height] of a part of it",
      .taker = "a dome",
      .description =
          "equidistant azimuthal fisheye of {} degrees. The circle touches\n"
          "the left and right edges; what is beside it is black.",
      .orientation = kDomeOrientation};
  int columns = 4096, rows = 4096;  // pixels, > 0, rows <= columns * pixel_aspect
  double fov = 1;                   // opening angle of the circle, radians, in (0, 2 pi]
  double cut_back = 0.5;  // the part, 0 to 1, of the missing rows that is cut at the top, the back
  double pixel_aspect = 1;

  double scale() const { return fov / columns; }
  double largest_pixel_angle() const { return scale(); }
  CameraDirection direction(Centred at) const { return equidistant_direction(scale(), at); }
  std::optional<Centred> place(const CameraDirection& n) const {
    return equidistant_place(columns / fov, n);
  }
  AngularScales scales(Centred at) const { return equidistant_scales(scale(), at); }
  double scale_change(const CameraDirection& n) const { return equidistant_scale_change(n); }
  CapBox cap_box(const CameraDirection& n, double angle) const {
    return equidistant_cap_box(scale(), n, angle);
  }
  CapSpans cap_spans(const CapPlace& cap, PixelPosition origin, int row,
                     const ColumnRange& inside) const {
    return equidistant_cap_spans(scale(), cap, origin, row, inside);
  }
  // One of nearly the whole sphere stretches the direction -Z into the whole rim.
  bool has_slanted_areas(int) const {
    constexpr double kNearlyWhole = 5;  // radians
    return fov > kNearlyWhole;
  }

  struct View {
    double scale;

    CameraDirection direction(double x, double y) const {
      const double r = std::sqrt(x * x + y * y);
      const SineCosine theta = sin_cos(r * scale);
      const double k = r > 1e-6 ? theta.sine / r : scale;  // the limit of sin(theta)/r
      return {{x * k, y * k, theta.cosine}};
    }
    double pixel_angle(double, double) const { return scale; }
    double area(const CameraDirection& n, double x, double y) const {
      return equidistant_area(scale, n, x, y);
    }
  };
  View view() const { return {scale()}; }
};

}  // namespace domefall
