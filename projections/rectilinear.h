#pragma once

#include "projections/projection_parts.h"

namespace domefall {

// A Rectilinear image is the flat image of a camera without distortion, in which straight lines
// stay straight.
struct Rectilinear {
  static constexpr ProjectionTraits kTraits{.name = "rectilinear",
                                            .keeps_lines = true,
                                            .usual_deg = 90,
                                            .widest_deg = 170,
                                            .description = "a flat picture (rectilinear)"};
  int columns = 1920, rows = 1080;  // pixels, > 0
  double fov = 1;                   // full horizontal opening angle, radians, in (0, pi)
  double pixel_aspect = 1;

  // Returns tan(theta) per pixel.
  double scale() const { return 2 * std::tan(fov / 2) / columns; }
  double largest_pixel_angle() const { return scale(); }
  CameraDirection direction(Centred at) const {
    const double k = scale(), x = at.x * k, y = at.y * k;
    const double cosine = 1 / std::sqrt(1 + x * x + y * y);
    return {{x * cosine, y * cosine, cosine}};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    return place_about_z(n.v.z > 0 ? 1 / (scale() * n.v.z) : HUGE_VAL, n);
  }
  // theta = arctan(k rho) grows by k cos^2(theta) a pixel, and sin(theta)/rho is k cos(theta).
  AngularScales scales(Centred at) const {
    const double k = scale();
    const double cosine = 1 / std::sqrt(1 + (at.x * at.x + at.y * at.y) * k * k);
    return {k * cosine * cosine, k * cosine};
  }
  // A pixel covers cos(theta)^2 of that in the middle along the direction to the middle.  The
  // logarithmic derivative of this is -2 tan(theta).
  double scale_change(const CameraDirection& n) const {
    return 2 * tangent_or_endless(n.v.z, std::hypot(n.v.x, n.v.y));
  }
  CapBox cap_box(const CameraDirection& n, double angle) const;
  bool has_slanted_areas(int) const { return false; }

  struct View {
    double scale;

    CameraDirection direction(double x, double y) const {
      const double u = x * scale, v = y * scale, cosine = 1 / std::sqrt(1 + u * u + v * v);
      return {{u * cosine, v * cosine, cosine}};
    }
    // A pixel covers scale cos(theta) across the direction to the middle, which is more than the
    // scale cos^2(theta) along it.
    double pixel_angle(double x, double y) const {
      return scale / std::sqrt(1 + (x * x + y * y) * scale * scale);
    }
    double area(const CameraDirection&, double, double) const { return 1; }  // hardly differs
  };
  View view() const { return {scale()}; }
};

// Column X of the image, in units of tan(theta), is the plane x = X z.  The sine of its angle to n
// is |n.x - X n.z|/sqrt(1 + X^2), so that the plane touches the cone of half angle `angle` about n
// where
//     (n.x - X n.z)^2 = sin^2(angle) (1 + X^2).
// The two solutions of this quadratic equation are the least and the most X.
inline CapBox Rectilinear::cap_box(const CameraDirection& n, double angle) const {
  const double theta = std::acos(std::clamp(n.v.z, -1.0, 1.0));
  if (theta + angle > std::numbers::pi / 2 - 1e-3) {
    CapBox whole = square_box(kWholeImage);
    whole.reach *= std::numbers::sqrt2;
    return whole;
  }
  const double per_tangent = 1 / scale();
  const double s2 = std::sin(angle) * std::sin(angle), a = n.v.z * n.v.z - s2;
  // Returns how far the least and the most X, or Y, are from the cap's middle.
  const auto edges = [&](double along) {
    const double b = along * n.v.z, root = std::sqrt(s2 * std::max(0.0, a + along * along));
    const double middle = along / n.v.z;
    return std::array{(middle - (b - root) / a) * per_tangent + 1,
                      ((b + root) / a - middle) * per_tangent + 1};
  };
  const std::array across = edges(n.v.x), down = edges(n.v.y);
  CapBox box{across[0], across[1], down[0], down[1], 0};
  // This is the distance of its corners at most.
  box.reach = std::max({box.left, box.right, box.up, box.down}) * std::numbers::sqrt2;
  return box;
}

}  // namespace domefall
