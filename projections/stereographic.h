#pragma once

#include "projections/projection_parts.h"

namespace domefall {

// A Stereographic image is a conformal flat image, in which the hole's silhouette stays a circle
// ([Riazuelo] eq. pix_i, pix_j).
struct Stereographic {
  static constexpr ProjectionTraits kTraits{.name = "stereographic",
                                            .keeps_circles = true,
                                            .usual_deg = 90,
                                            .widest_deg = 360,
                                            .below_widest = true,
                                            .description = "a flat picture (stereographic)"};
  int columns = 1920, rows = 1080;  // pixels, > 0
  double fov = 1;                   // full horizontal opening angle 2 alpha, radians, in (0, 2 pi)
  double pixel_aspect = 1;

  // Returns the paper's 2 tan(alpha/2)/C, which is tan(theta/2) per pixel.
  double scale() const { return 2 * std::tan(fov / 4) / columns; }
  double largest_pixel_angle() const { return 2 * scale(); }
  // N = -Z + 2 W/|W|^2 with W = Z + w is written so that nothing cancels near the middle.
  CameraDirection direction(Centred at) const {
    const double k = scale(), x = at.x * k, y = at.y * k;
    const double w2 = x * x + y * y;
    return {{2 * x / (1 + w2), 2 * y / (1 + w2), (1 - w2) / (1 + w2)}};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    // 1 + cos(theta) is found from the sine where the sum would cancel.
    const double sine2 = n.v.x * n.v.x + n.v.y * n.v.y;
    const double one_plus_cos = n.v.z >= 0 ? 1 + n.v.z : sine2 / (1 - n.v.z);
    return place_about_z(1 / (scale() * one_plus_cos), n);
  }
  // The projection is conformal.
  AngularScales scales(Centred at) const {
    const double k = scale();
    const double w2 = (at.x * at.x + at.y * at.y) * k * k;
    const double side = 2 * k / (1 + w2);
    return {side, side};
  }
  // A pixel covers cos(theta/2)^2 of what it covers in the middle.  The logarithmic derivative of
  // this is -tan(theta/2), and tan(theta/2) = sin(theta)/(1 + cos(theta)).
  double scale_change(const CameraDirection& n) const {
    return tangent_or_endless(1 + n.v.z, std::hypot(n.v.x, n.v.y));
  }
  // The pixels per radian grow towards -Z, where the box is the whole image.
  CapBox cap_box(const CameraDirection& n, double angle) const {
    const double c = std::cos(std::min(angle_to_middle(n) + angle, std::numbers::pi) / 2);
    return square_box((c > 1e-4 ? angle * (1 / (2 * scale())) / (c * c) : kWholeImage) + 1);
  }
  bool has_slanted_areas(int) const { return false; }

  struct View {
    double scale;

    CameraDirection direction(double x, double y) const {
      const double u = x * scale, v = y * scale, w2 = u * u + v * v, inverse = 1 / (1 + w2);
      return {{2 * u * inverse, 2 * v * inverse, (1 - w2) * inverse}};
    }
    double pixel_angle(double x, double y) const {
      return 2 * scale / (1 + (x * x + y * y) * scale * scale);
    }
    double area(const CameraDirection&, double, double) const { return 1; }  // hardly differs
  };
  View view() const { return {scale()}; }
};

}  // namespace domefall
