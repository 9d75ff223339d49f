// From direction to pixel and back, for the camera of [Riazuelo] sec. sec_cam: Z looks through the
// middle of the image, X to its right edge, Y to its bottom edge, (X, Y, Z) right-handed.
// Pixel coordinates (i, j) are continuous and counted from 1: pixel centres are whole numbers,
// (1, 1) is the centre of the top left pixel.
#pragma once

#include <Imath/ImathVec.h>

#include <optional>
#include <string_view>
#include <variant>

namespace domefall {

// Unit vector with components along the camera's X, Y, Z.
struct CameraDirection {
  Imath::V3d v;
};

struct PixelPosition {
  double i, j;
};

// Equidistant azimuthal fisheye of a half sphere in a square of `size` pixels: Z is the dome's
// zenith (its axis), the bottom edge is the audience's front, the right edge its right hand.
// [Riazuelo] eq. pix_i_geode, pix_j_geode.  Valid outside the incircle too, up to theta = pi.
struct Domemaster {
  int size;  // pixels, > 0
};

// Conformal flat picture: the hole's silhouette stays a circle.  [Riazuelo] eq. pix_i, pix_j.
struct Stereographic {
  int columns, rows;  // pixels, > 0
  double fov;         // full horizontal opening angle 2 alpha, radians, in (0, 2 pi)
};

using Projection = std::variant<Domemaster, Stereographic>;

int columns(const Projection& p);
int rows(const Projection& p);

// The same picture with `factor` times `factor` pixels for each.
Projection refined(const Projection& p, int factor);

// The direction that a pixel position looks along.  Exact to a few epsilon; defined for any finite
// position (on a Domemaster beyond theta = pi it winds on, which no pixel of the image does).
CameraDirection direction_at(const Projection& p, PixelPosition pixel);

// The inverse.  Nothing for the one direction without an image, -Z.
std::optional<PixelPosition> pixel_of(const Projection& p, CameraDirection n);

// Whether the projection shows anything there: the Domemaster's incircle, else everything.
bool is_inside(const Projection& p, PixelPosition pixel);

// The pixels of a row (from 0) whose centres are inside: columns first..last (from 0), none if
// first > last.
struct ColumnRange {
  int first, last;
};
ColumnRange inside_columns(const Projection& p, int row);

// direction_at for the centres of those pixels, into out[last - first + 1], in a quarter of the
// time: by power series, cut below 1e-17.  Measured: within 6e-16 of direction_at.
void inside_directions(const Projection& p, int row, ColumnRange range, CameraDirection* out);

// direction_at for `count` positions of a row, evenly spaced from `first` on, into out[count]: by
// the same series, also outside the incircle of a Domemaster.  Measured: within 1e-14 up to theta =
// 0.75 pi.
void directions_along(const Projection& p, PixelPosition first, double step, int count,
                      CameraDirection* out);

// Solid angle (sr) of the pixel centred there: the product of its two angular scales.
double pixel_solid_angle(const Projection& p, PixelPosition pixel);

// Angle (radians) between neighbouring pixels in the middle of the image.
double central_pixel_angle(const Projection& p);

// The same at a pixel, along the direction to the middle.
double pixel_angle(const Projection& p, PixelPosition pixel);

std::string_view projection_name(const Projection& p);

}  // namespace domefall
