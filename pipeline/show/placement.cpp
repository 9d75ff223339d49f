#include "pipeline/show/placement.h"

#include <cmath>

namespace domefall {

M33d place_tetrad(const SkyDirection& hole_at, double heading, double azimuth) {
  const V3d r0 = -hole_at.v;
  const bool at_pole = std::hypot(r0.x, r0.y) < 1e-12;
  // The tangent of growing right ascension at R0 is (-y, x, 0).  At a pole it is that of RA 0,
  // which is (0, 1, 0).
  const V3d east = at_pole ? V3d(0, 1, 0) : V3d(-r0.y, r0.x, 0).normalized();
  const V3d north = r0.cross(east);
  const V3d t = north * std::cos(heading) + east * std::sin(heading);
  // R0 x (-R0 x t) = t, so that the columns are right-handed.
  return moved_on(from_columns(r0, -r0.cross(t), t), azimuth);
}

M33d moved_on(const M33d& axes, double azimuth) {
  // R turns towards Phi about the orbit's north, -Theta, which stays.
  const V3d r0 = column(axes, 0), t = column(axes, 2);
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  return from_columns(r0 * c + t * s, column(axes, 1), t * c - r0 * s);
}

M33d turned(const M33d& axes, double turn) {
  // Phi turns towards the north, -Theta, about R, which stays.
  const V3d south = column(axes, 1), t = column(axes, 2);
  const double c = std::cos(turn), s = std::sin(turn);
  return from_columns(column(axes, 0), south * c + t * s, t * c - south * s);
}

// Phi tells the azimuth on the axis, too.  Where an orbit's Phi is not horizontal, R does.
M33d moved_about(const V3d& axis, const M33d& axes, double theta, double azimuth) {
  const V3d r = column(axes, 0), along = column(axes, 2), level = r - axis * r.dot(axis);
  const bool horizontal = std::abs(along.dot(axis)) < 1e-9 || level.length() < 1e-9;
  const V3d out = (horizontal ? along.cross(axis) : level).normalized();
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  const V3d turned = out * c + axis.cross(out) * s;
  const V3d place = turned * std::sin(theta) + axis * std::cos(theta);
  return from_columns(place, turned * std::cos(theta) - axis * std::sin(theta), axis.cross(turned));
}

OrbitPoint placed(OrbitPoint point, const Placement& placement) {
  // The null time of a mirrored tetrad counts after t -> -t (orbit_point.h), and so stays.
  if (placement.mirrored) {
    point.region = mirror_of(point.region);
    point.tetrad = mirror_of(point.tetrad);
  }
  if (placement.backward) {
    point.azimuth = -point.azimuth;
    point.celerity.z = -point.celerity.z;
  }
  return point;
}

}  // namespace domefall
