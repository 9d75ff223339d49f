// A projection leads from direction to pixel and back, for the camera of [Riazuelo] sec. sec_cam
// with the unit vectors X, Y and Z, (X, Y, Z) right-handed.  A flat image has Z in its middle, X to
// its right edge and Y to its bottom edge.  Images for an audience, which has_zenith() tells, take
// Z for its zenith, X for its right hand and Y for its front, so that one camera serves them all.
// A dome has the zenith in its middle and the front at its bottom edge.  An image of the whole
// sphere has the front in its middle and the zenith at its top edge.
//
// Pixel coordinates (i, j) are continuous and counted from 1.  Pixel centres are whole numbers, and
// (1, 1) is the centre of the top left pixel.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

namespace domefall {

// A CameraDirection is a unit vector with components along the camera's X, Y, Z.
struct CameraDirection {
  Imath::V3d v;
};

struct PixelPosition {
  double i, j;
};

// A Domemaster is an equidistant azimuthal fisheye of a half sphere in a square of `size` pixels
// ([Riazuelo] eq. pix_i_geode, pix_j_geode).  Z is the dome's zenith (its axis), the bottom edge is
// the audience's front, and the right edge its right hand.  It is valid outside the incircle too,
// up to theta = pi.
struct Domemaster {
  static constexpr std::string_view kName = "domemaster";
  int size;  // pixels, > 0
};

// A Stereographic image is a conformal flat image, in which the hole's silhouette stays a circle
// ([Riazuelo] eq. pix_i, pix_j).
struct Stereographic {
  static constexpr std::string_view kName = "stereographic";
  int columns, rows;  // pixels, > 0
  double fov;         // full horizontal opening angle 2 alpha, radians, in (0, 2 pi)
};

// A Rectilinear image is the flat image of a camera without distortion, in which straight lines
// stay straight.
struct Rectilinear {
  static constexpr std::string_view kName = "rectilinear";
  int columns, rows;  // pixels, > 0
  double fov;         // full horizontal opening angle, radians, in (0, pi)
};

// A Fisheye is an equidistant azimuthal fisheye of any opening, for domes of more or less than a
// half sphere.  Its circle is as wide as the image.  An image lower than that is of a truncated
// dome.
struct Fisheye {
  static constexpr std::string_view kName = "fisheye";
  int columns, rows;  // pixels, > 0, rows <= columns
  double fov;         // opening angle of the circle, radians, in (0, 2 pi]
  double cut_back;    // the part, 0 to 1, of the missing rows that is cut at the top, the back
};

// An Equirectangular image is the whole sphere by longitude and latitude, as virtual reality has
// it, with columns/2 rows.  The left and the right edge are one meridian, the back's.
struct Equirectangular {
  static constexpr std::string_view kName = "equirectangular";
  int columns;  // pixels, > 0, even
};

// A Cubemap is the whole sphere on the faces of a cube, in two rows of three: right, left, up;
// down, front, back.  Each is a flat image of 90 degrees, upright but for up and down, which have
// the front at their bottom and top edge.  This is the layout c3x2 of ffmpeg's filter v360.
struct Cubemap {
  static constexpr std::string_view kName = "cubemap";
  int face;  // pixels along an edge, > 0
};

using Projection =
    std::variant<Domemaster, Stereographic, Rectilinear, Fisheye, Equirectangular, Cubemap>;

// The names of all projections, in that order.
inline constexpr auto kProjectionNames =
    []<class... Each>(std::type_identity<std::variant<Each...>>) {
      return std::array{Each::kName...};
    }(std::type_identity<Projection>());

int columns(const Projection& p);
int rows(const Projection& p);

// Returns the same image with `factor` times `factor` pixels for each.
Projection refined(const Projection& p, int factor);

// Says whether Z is an audience's zenith, and not the direction that a camera looks along.
bool has_zenith(const Projection& p);

// These return the opening angle (radians), or nothing for a projection whose angle is always the
// same, and the projection with another angle.
std::optional<double> field_of_view(const Projection& p);
Projection with_field_of_view(Projection p, double fov);

// Returns the direction that a pixel position looks along.  It is exact to a few epsilon and
// defined for any finite position.  On a fisheye beyond theta = pi, and beyond the edges of a
// sphere by longitude and latitude, it winds on.  Beyond the edges of a cube's net it is on the
// plane of the nearest face.
CameraDirection direction_at(const Projection& p, PixelPosition pixel);

// Returns the inverse, or nothing for a direction without a place in the image.  Such directions
// are -Z on a stereographic image or a fisheye, and all behind a rectilinear one (z <= 0).
// Directions with several places, those on an edge of an image of the whole sphere, get one of
// them.
std::optional<PixelPosition> pixel_of(const Projection& p, CameraDirection n);

// Says whether the projection shows anything there.  A fisheye shows its circle, and all others
// show everything.
bool is_inside(const Projection& p, PixelPosition pixel);

// A ColumnRange has the pixels of a row (from 0) whose centres are inside.  These are columns
// first..last (from 0), and none if first > last.
struct ColumnRange {
  int first, last;
};
ColumnRange inside_columns(const Projection& p, int row);

// Writes direction_at for the centres of those pixels into out[last - first + 1], in a quarter of
// the time, by power series that are cut below 1e-17.  Measured, it is within 6e-16 of
// direction_at.
void inside_directions(const Projection& p, int row, ColumnRange range, CameraDirection* out);

// Writes direction_at for `count` positions of a row, evenly spaced from `first` on, into
// out[count], by the same series, also outside the incircle of a Domemaster.  Measured, it is
// within 1e-14 up to theta = 0.75 pi.
void directions_along(const Projection& p, PixelPosition first, double step, int count,
                      CameraDirection* out);

// Returns the solid angle (sr) of the pixel centred there, which is the product of its two angular
// scales.
double pixel_solid_angle(const Projection& p, PixelPosition pixel);

// A PixelMetric says how a projection scales at a place.  A small step of (dx, dy) pixels turns the
// direction by the square root of xx dx^2 + 2 xy dx dy + yy dy^2, in radians.
struct PixelMetric {
  double xx, xy, yy;
};
PixelMetric pixel_metric(const Projection& p, PixelPosition pixel);

// Returns the angle (radians) between neighbouring pixels in the middle of the image, or on the
// horizon of a sphere by longitude and latitude.  No pixel covers a larger angle in any direction.
double central_pixel_angle(const Projection& p);

// Returns the largest angle that a pixel covers in any direction.
double pixel_angle(const Projection& p, PixelPosition pixel);

std::string_view projection_name(const Projection& p);

}  // namespace domefall
