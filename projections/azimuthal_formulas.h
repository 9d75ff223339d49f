// These are the formulas of projections about the axis Z, which projection.h uses.  A place is
// given in pixels from the one that looks along Z.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "projections/inside_direction.h"

namespace domefall {

struct Centred {
  double x, y;
};

// Returns sin(theta)/theta, with its limit at 0.
inline double sinc(double theta) { return theta < 1e-8 ? 1.0 : std::sin(theta) / theta; }

// Returns the paper's 2 tan(alpha/2)/C, which is tan(theta/2) per pixel.
inline double half_tangent_per_pixel(const Stereographic& s) {
  return 2 * std::tan(s.fov / 4) / s.columns;
}
// Returns tan(theta) per pixel.
inline double tangent_per_pixel(const Rectilinear& r) {
  return 2 * std::tan(r.fov / 2) / r.columns;
}
inline double radians_per_pixel(const Domemaster& d) { return std::numbers::pi / d.size; }
inline double radians_per_pixel(const Fisheye& f) { return f.fov / f.columns; }

// AngularScales are the angles that a pixel covers along the direction to the middle, and across
// it.
struct AngularScales {
  double radial, tangential;
};

// Returns the metric of a projection about Z.
inline PixelMetric metric_of(const AngularScales& s, Centred at) {
  const double r2 = at.x * at.x + at.y * at.y, across = s.tangential * s.tangential;
  const double more = r2 > 0 ? (s.radial * s.radial - across) / r2 : 0;
  return {across + more * at.x * at.x, more * at.x * at.y, across + more * at.y * at.y};
}

// ---- equidistant ----

inline CameraDirection equidistant_direction(double scale, Centred at) {
  const double theta = std::hypot(at.x, at.y) * scale;
  const double k = sinc(theta) * scale;
  return {{at.x * k, at.y * k, std::cos(theta)}};
}
inline CameraDirection direction(const Domemaster& d, Centred at) {
  return equidistant_direction(radians_per_pixel(d), at);
}
inline CameraDirection direction(const Fisheye& f, Centred at) {
  return equidistant_direction(radians_per_pixel(f), at);
}

// Returns the pixels per unit of (X.N, Y.N), which are infinite towards -Z.
inline double equidistant_magnification(double per_radian, const CameraDirection& n) {
  const double sine = std::hypot(n.v.x, n.v.y);
  if (sine == 0) return n.v.z > 0 ? per_radian : HUGE_VAL;
  return per_radian * std::atan2(sine, n.v.z) / sine;
}
inline double magnification(const Domemaster& d, const CameraDirection& n) {
  return equidistant_magnification(d.size / std::numbers::pi, n);
}
inline double magnification(const Fisheye& f, const CameraDirection& n) {
  return equidistant_magnification(f.columns / f.fov, n);
}

inline AngularScales scales(const Domemaster& d, Centred at) {
  const double scale = radians_per_pixel(d);
  return {scale, scale * sinc(std::hypot(at.x, at.y) * scale)};
}
inline AngularScales scales(const Fisheye& f, Centred at) {
  const double scale = radians_per_pixel(f);
  return {scale, scale * std::abs(sinc(std::hypot(at.x, at.y) * scale))};
}

// ---- stereographic ----

// N = -Z + 2 W/|W|^2 with W = Z + w is written so that nothing cancels near the middle.
inline CameraDirection direction(const Stereographic& s, Centred at) {
  const double scale = half_tangent_per_pixel(s);
  const double x = at.x * scale, y = at.y * scale;
  const double w2 = x * x + y * y;
  return {{2 * x / (1 + w2), 2 * y / (1 + w2), (1 - w2) / (1 + w2)}};
}

inline double magnification(const Stereographic& s, const CameraDirection& n) {
  // 1 + cos(theta) is found from the sine where the sum would cancel.
  const double sine2 = n.v.x * n.v.x + n.v.y * n.v.y;
  const double one_plus_cos = n.v.z >= 0 ? 1 + n.v.z : sine2 / (1 - n.v.z);
  return 1 / (half_tangent_per_pixel(s) * one_plus_cos);
}

// The projection is conformal.
inline AngularScales scales(const Stereographic& s, Centred at) {
  const double k = half_tangent_per_pixel(s);
  const double w2 = (at.x * at.x + at.y * at.y) * k * k;
  const double side = 2 * k / (1 + w2);
  return {side, side};
}

// ---- rectilinear ----

inline CameraDirection direction(const Rectilinear& r, Centred at) {
  const double scale = tangent_per_pixel(r), x = at.x * scale, y = at.y * scale;
  const double cosine = 1 / std::sqrt(1 + x * x + y * y);
  return {{x * cosine, y * cosine, cosine}};
}

inline double magnification(const Rectilinear& r, const CameraDirection& n) {
  return n.v.z > 0 ? 1 / (tangent_per_pixel(r) * n.v.z) : HUGE_VAL;
}

// theta = arctan(k rho) grows by k cos^2(theta) a pixel, and sin(theta)/rho is k cos(theta).
inline AngularScales scales(const Rectilinear& r, Centred at) {
  const double k = tangent_per_pixel(r);
  const double cosine = 1 / std::sqrt(1 + (at.x * at.x + at.y * at.y) * k * k);
  return {k * cosine * cosine, k * cosine};
}

// ---- what all of them share ----

template <class Azimuthal>
std::optional<Centred> place(const Azimuthal& p, const CameraDirection& n) {
  const double m = magnification(p, n);
  if (!std::isfinite(m)) return std::nullopt;
  return Centred{m * n.v.x, m * n.v.y};
}

template <class Azimuthal>
PixelMetric metric(const Azimuthal& p, Centred at) {
  return metric_of(scales(p, at), at);
}

template <class Azimuthal>
double solid_angle(const Azimuthal& p, Centred at) {
  const AngularScales s = scales(p, at);
  return s.radial * s.tangential;
}
inline double solid_angle(const Domemaster& d, Centred at) {
  const double scale = radians_per_pixel(d);
  return scale * scale * sinc(std::hypot(at.x, at.y) * scale);
}

}  // namespace domefall
