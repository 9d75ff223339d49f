#pragma once

#include "projections/rectilinear.h"

namespace domefall {

// A Cubemap is the whole sphere on the faces of a cube, in two rows of three: right, left, up;
// down, front, back.  Each is a flat image of 90 degrees, upright but for up and down, which have
// the front at their bottom and top edge.  This is the layout c3x2 of ffmpeg's filter v360.  The
// renderer draws each face as an image of its own (cubemap_faces), so that nothing here need be
// quick.
struct Cubemap {
  static constexpr ProjectionTraits kTraits{
      .name = "cubemap",
      .has_zenith = true,
      .has_faces = true,
      .shown_deg = 360,
      .one_number = "the edge of a face, of which three make the width",
      .taker = "the faces of a cubemap",
      .in_width = 3,
      .description =
          "the whole sphere on the faces of a cube, three by two:\n"
          "right, left, up; down, front, back"};
  int face = 1024;  // pixels along an edge, > 0

  static constexpr int kFacesInARow = 3;
  int width() const { return kFacesInARow * face; }
  int height() const { return 2 * face; }
  Cubemap with_sides(int columns, int) const { return {std::max(1, columns / kFacesInARow)}; }

  // These are the axes of a face's camera, to its right edge, to its bottom edge, and through its
  // middle.
  struct Axes {
    Imath::V3d right, down, forward;
  };
  static const std::array<Axes, 6>& axes() {
    static const std::array<Axes, 6> kAxes{{{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}},
                                            {{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}},
                                            {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                            {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                            {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                            {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}}};
    return kAxes;
  }
  Rectilinear face_projection() const { return {face, face, std::numbers::pi / 2}; }

  // Returns the middle of a face, from the middle of the net.
  Centred middle_of_face(std::size_t k) const {
    const auto column = static_cast<int>(k % kFacesInARow),
               row = static_cast<int>(k / kFacesInARow);
    return {(column - 1.0) * face, (row - 0.5) * face};
  }
  // Returns the face on which a place of the net is, or the nearest to one beside it.
  std::size_t face_at(Centred at) const {
    const double column = std::clamp(std::floor(at.x / face + 1.5), 0.0, 2.0);
    return static_cast<std::size_t>(column) + (at.y < 0 ? 0 : kFacesInARow);
  }
  Centred on_its_face(Centred at) const {
    const Centred middle = middle_of_face(face_at(at));
    return {at.x - middle.x, at.y - middle.y};
  }

  double largest_pixel_angle() const { return face_projection().largest_pixel_angle(); }
  CameraDirection direction(Centred at) const {
    const Imath::V3d v = face_projection().direction(on_its_face(at)).v;
    const Axes& f = axes()[face_at(at)];
    return {f.right * v.x + f.down * v.y + f.forward * v.z};
  }
  std::optional<Centred> place(const CameraDirection& n) const {
    const auto nearest =
        std::ranges::max_element(axes(), {}, [&](const Axes& f) { return f.forward.dot(n.v); });
    const Centred middle = middle_of_face(static_cast<std::size_t>(nearest - axes().begin()));
    const auto at = face_projection().place(
        {{nearest->right.dot(n.v), nearest->down.dot(n.v), nearest->forward.dot(n.v)}});
    // Rounding may put what is on an edge a little beyond it, on another face of the net.
    const double most = std::nextafter(face / 2.0, 0.0);
    return Centred{middle.x + std::clamp(at->x, -most, most),
                   middle.y + std::clamp(at->y, -most, most)};
  }
  PixelMetric metric(Centred at) const {
    return metric_about_z(face_projection().scales(on_its_face(at)), on_its_face(at));
  }
  double solid_angle(Centred at) const {
    const AngularScales s = face_projection().scales(on_its_face(at));
    return s.radial * s.tangential;
  }
  double pixel_angle(Centred at) const {
    return face_projection().scales(on_its_face(at)).tangential;
  }
  // A face is a rectilinear image.  theta is largest in its corners, where tan(theta) = sqrt 2.
  double scale_change(const CameraDirection&) const { return 2 * std::numbers::sqrt2; }
};

}  // namespace domefall
