// These are the formulas of images of the whole sphere, which projection.h uses.  A place is given
// in pixels from the middle of the image.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "projections/azimuthal_formulas.h"

namespace domefall {

// ---- longitude, from the front to the right, and latitude ----

inline double radians_per_pixel(const Equirectangular& e) {
  return 2 * std::numbers::pi / e.columns;
}

inline CameraDirection direction(const Equirectangular& e, Centred at) {
  const double scale = radians_per_pixel(e), longitude = at.x * scale, latitude = -at.y * scale;
  const double across = std::cos(latitude);
  return {{std::sin(longitude) * across, std::cos(longitude) * across, std::sin(latitude)}};
}

inline std::optional<Centred> place(const Equirectangular& e, const CameraDirection& n) {
  const double per_radian = e.columns / (2 * std::numbers::pi);
  return Centred{per_radian * std::atan2(n.v.x, n.v.y),
                 -per_radian * std::atan2(n.v.z, std::hypot(n.v.x, n.v.y))};
}

inline PixelMetric metric(const Equirectangular& e, Centred at) {
  const double scale = radians_per_pixel(e), across = scale * std::cos(at.y * scale);
  return {across * across, 0, scale * scale};
}

inline double solid_angle(const Equirectangular& e, Centred at) {
  const double scale = radians_per_pixel(e);
  return scale * scale * std::cos(at.y * scale);
}

// ---- the faces of a cube ----

// These are the axes of a face's camera, to its right edge, to its bottom edge, and through its
// middle.
struct FaceAxes {
  Imath::V3d right, down, forward;
};
inline const std::array<FaceAxes, 6> kFaceAxes{{{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}},
                                                {{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}},
                                                {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                                {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                                {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}}};
inline constexpr int kFacesInARow = 3;

inline Rectilinear face_projection(const Cubemap& c) {
  return {c.face, c.face, std::numbers::pi / 2};
}

// Returns the middle of a face, from the middle of the net.
inline Centred middle_of_face(const Cubemap& c, std::size_t face) {
  const auto column = static_cast<int>(face % kFacesInARow);
  const auto row = static_cast<int>(face / kFacesInARow);
  return {(column - 1.0) * c.face, (row - 0.5) * c.face};
}

// Returns the face on which a place of the net is, or the nearest to one beside it.
inline std::size_t face_at(const Cubemap& c, Centred at) {
  const double column = std::clamp(std::floor(at.x / c.face + 1.5), 0.0, 2.0);
  return static_cast<std::size_t>(column) + (at.y < 0 ? 0 : kFacesInARow);
}

inline Centred on_face(const Cubemap& c, std::size_t face, Centred at) {
  const Centred middle = middle_of_face(c, face);
  return {at.x - middle.x, at.y - middle.y};
}

inline CameraDirection direction(const Cubemap& c, Centred at) {
  const std::size_t face = face_at(c, at);
  const Imath::V3d v = direction(face_projection(c), on_face(c, face, at)).v;
  const FaceAxes& f = kFaceAxes[face];
  return {f.right * v.x + f.down * v.y + f.forward * v.z};
}

inline std::optional<Centred> place(const Cubemap& c, const CameraDirection& n) {
  const auto nearest = std::ranges::max_element(
      kFaceAxes, {}, [&](const FaceAxes& f) { return f.forward.dot(n.v); });
  const Centred middle = middle_of_face(c, static_cast<std::size_t>(nearest - kFaceAxes.begin()));
  const auto at =
      place(face_projection(c),
            {{nearest->right.dot(n.v), nearest->down.dot(n.v), nearest->forward.dot(n.v)}});
  // Rounding may put what is on an edge a little beyond it, on another face of the net.
  const double most = std::nextafter(c.face / 2.0, 0.0);
  return Centred{middle.x + std::clamp(at->x, -most, most),
                 middle.y + std::clamp(at->y, -most, most)};
}

inline PixelMetric metric(const Cubemap& c, Centred at) {
  return metric(face_projection(c), on_face(c, face_at(c, at), at));
}
inline double solid_angle(const Cubemap& c, Centred at) {
  return solid_angle(face_projection(c), on_face(c, face_at(c, at), at));
}

}  // namespace domefall
