// Formulas of azimuthal images about Z on which the distance from the middle is proportional to the
// angle, those of domes.  `scale` is that angle per pixel, in radians.
#pragma once

#include "projections/projection_parts.h"

namespace domefall {

// Returns sin(theta)/theta, with its limit at 0.
inline double sinc(double theta) { return theta < 1e-8 ? 1.0 : std::sin(theta) / theta; }

inline CameraDirection equidistant_direction(double scale, Centred at) {
  const double theta = std::hypot(at.x, at.y) * scale;
  const double k = sinc(theta) * scale;
  return {{at.x * k, at.y * k, std::cos(theta)}};
}

// Returns the place of a direction.  There is none towards -Z.
inline std::optional<Centred> equidistant_place(double pixels_per_radian,
                                                const CameraDirection& n) {
  const double sine = std::hypot(n.v.x, n.v.y);
  if (sine == 0) return place_about_z(n.v.z > 0 ? pixels_per_radian : HUGE_VAL, n);
  return place_about_z(pixels_per_radian * std::atan2(sine, n.v.z) / sine, n);
}

inline AngularScales equidistant_scales(double scale, Centred at) {
  return {scale, scale * std::abs(sinc(std::hypot(at.x, at.y) * scale))};
}

// Across the direction to the middle a pixel covers sin(theta)/theta of what it covers there.  The
// series of 1/theta - cot(theta), the logarithmic derivative, begins with theta/3.
inline double equidistant_scale_change(const CameraDirection& n) {
  const double sine = std::hypot(n.v.x, n.v.y), theta = std::atan2(sine, n.v.z);
  if (theta < 0.01) return theta / 3;
  return sine > 0 ? 1 / theta - n.v.z / sine : kEndlessChange;
}

// Pixels cover solid angles that go like sin(theta)/r at the distance r from the middle.  There the
// limit is `scale`.
inline double equidistant_area(double scale, const CameraDirection& n, double x, double y) {
  const double aside = std::sqrt(n.v.x * n.v.x + n.v.y * n.v.y);
  const double from_middle = std::sqrt(x * x + y * y);
  const bool off = from_middle > 1e-3;
  return off ? aside / (off ? from_middle : 1.0) : scale;
}

// The box is a square of the most pixels by which the angle `reach` may lead away from n.  It is
// the whole image where the cap might surround the middle or -Z.
inline CapBox equidistant_cap_box(double scale, const CameraDirection& n, double reach) {
  const double theta = angle_to_middle(n), far = theta + reach;
  const double centre = 1 / scale;
  // The pixels per radian along the tangent are theta/sin(theta) times those in the middle.
  if (far < std::numbers::pi / 2) return square_box(reach * centre * far / std::sin(far) + 1);
  // Farther out the cap lies between two meridians, and between theta - reach and theta + reach.
  // Its farthest point is nearer than the sum of a radial step and the chord across to such a
  // meridian.
  const double ratio = std::sin(std::min(reach, std::numbers::pi / 2)) / std::sin(theta);
  if (far >= std::numbers::pi || reach >= theta || ratio >= 1) return square_box(kWholeImage + 1);
  return square_box((reach + far * 2 * std::sin(std::asin(ratio) / 2)) * centre + 1);
}

// Far out on a fisheye a cap is long and bent, and covers little of the square around it.  It covers
// only pixels that are about as far from the middle of the circle as the cap's own middle.
inline CapSpans equidistant_cap_spans(double scale, const CapPlace& cap, PixelPosition origin,
                                      int row, const ColumnRange& inside) {
  constexpr double kNarrow = 2;
  CapSpans spans;
  const auto part = part_of_row(cap, row);
  if (!part) return spans;
  const double x = origin.i - 1, y = row - (origin.j - 1);
  const double from_middle = std::hypot(cap.x - x, cap.y - (origin.j - 1));
  const double half = cap.angle / scale + 1;
  const auto along_row = [y](double r) { return r > std::abs(y) ? std::sqrt(r * r - y * y) : 0; };
  const double outer = along_row(from_middle + half), inner = along_row(from_middle - half);
  const double left = std::max(part->left, x - outer - 1);
  const double right = std::min(part->right, x + outer + 1);
  // A gap of few columns is not worth two spans.
  if (inner < kNarrow) {
    spans.add(left, right, inside);
    return spans;
  }
  spans.add(left, std::min(part->right, x - inner + 1), inside);
  spans.add(std::max(part->left, x + inner - 1), right, inside);
  return spans;
}

}  // namespace domefall
