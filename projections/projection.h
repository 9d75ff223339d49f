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

#include <type_traits>
#include <variant>
#include <vector>

#include "projections/cubemap.h"
#include "projections/domemaster.h"
#include "projections/equirectangular.h"
#include "projections/fisheye.h"
#include "projections/rectilinear.h"
#include "projections/stereographic.h"

namespace domefall {

// The list of all projections, in the order of their names in the row `projection` of keys.cpp.
// What each says of itself is in projection_parts.h.
using Projection =
    std::variant<Domemaster, Fisheye, Equirectangular, Cubemap, Stereographic, Rectilinear>;

// The traits of all projections, and all projections in their usual sizes, in that order.
inline constexpr auto kEveryProjectionTraits =
    []<class... Each>(std::type_identity<std::variant<Each...>>) {
      return std::array{Each::kTraits...};
    }(std::type_identity<Projection>());
inline constexpr auto kUsualProjections =
    []<class... Each>(std::type_identity<std::variant<Each...>>) {
      return std::array{Projection(Each{})...};
    }(std::type_identity<Projection>());

inline const ProjectionTraits& traits_of(const Projection& p) {
  return kEveryProjectionTraits[p.index()];
}
inline std::string_view projection_name(const Projection& p) { return traits_of(p).name; }

// Says whether it is the projection for which the quick loops of domes hold.
inline bool is_domemaster(const Projection& p) { return std::holds_alternative<Domemaster>(p); }

int columns(const Projection& p);
int rows(const Projection& p);

// Returns the same image with `factor` times `factor` pixels for each.
Projection refined(const Projection& p, int factor);

inline bool has_zenith(const Projection& p) { return traits_of(p).has_zenith; }

// Says whether an image may be of any width and height, and not of one shape only.
bool has_free_shape(const Projection& p);

// Returns the largest image of a projection within these sides in pixels, both > 0.  One of a free
// shape has them, but that a fisheye has at most as many rows as columns.
Projection with_sides(Projection p, int columns, int rows);

// Returns the projection with an image of the same shape and as wide as that, or up to two pixels
// less where its width must be a multiple of 2 or 3.  Such a width is at least that 2 or 3.
Projection with_width(const Projection& p, int width);

// These return the opening angle (radians), or nothing for a projection whose angle is always the
// same, and the projection with another angle.
std::optional<double> field_of_view(const Projection& p);
Projection with_field_of_view(Projection p, double fov);

// These do so with the part of the missing rows that is cut at the back of a truncated dome
// (Fisheye), or nothing for a projection that has none to cut.
std::optional<double> cut_back(const Projection& p);
Projection with_cut_back(Projection p, double part);

// These return the width of a pixel over its height, which is 1 for all projections that are not
// free in it, and the projection with another aspect and as many pixels.
double pixel_aspect(const Projection& p);
bool may_have_pixel_aspect(const Projection& p);
Projection with_pixel_aspect(Projection p, double aspect);

// Returns the image as a screen of square pixels shows it, with as many columns.
Projection with_square_pixels(const Projection& p);

// Returns how many rows the circle of a fisheye has that is as wide as so many columns.
int most_rows(int columns, double pixel_aspect);

// ScreenSides are the sides of a pixel on the screen in units of the longer, so that the larger is 1.
// Places times these are in the proportions in which they are seen.
struct ScreenSides {
  double x, y;
};
ScreenSides screen_sides(const Projection& p);
// Returns the shorter side of the image on the screen, in that unit.
double shorter_side(const Projection& p);

// Says whether a circle on the sphere is a circle in pixels.
bool keeps_circles(const Projection& p);

// PixelParts divide each pixel into parts whose sides are as 1 to at most the root of 2.
struct PixelParts {
  int across, down;
};
PixelParts parts_nearly_square(const Projection& p);
// Returns the same image with a pixel for each part.
Projection divided(const Projection& p, const PixelParts& parts);

// Returns the numbers that define an image besides its projection's name, columns and rows.
std::vector<double> further_parameters(const Projection& p);

// Returns the largest angle from Z in an image, and of a dome that of its circle.
double farthest_angle(const Projection& p);

// Returns the position from which places are Centred: the middle of the image, or the pixel that
// looks along Z on a truncated dome.
PixelPosition origin_of(const Projection& p);

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

// Returns the columns (from 0) of the pixels of a row (from 0) whose centres are inside.
ColumnRange inside_columns(const Projection& p, int row);

// Returns the solid angle (sr) of the pixel centred there, which is the product of its two angular
// scales.
double pixel_solid_angle(const Projection& p, PixelPosition pixel);

PixelMetric pixel_metric(const Projection& p, PixelPosition pixel);

// Returns the largest angle (radians) that any pixel of the image covers in any direction.  Of those
// here it is that between neighbouring pixels in the middle, or on the horizon of a whole sphere.
double largest_pixel_angle(const Projection& p);

// Returns the largest angle that a pixel covers in any direction.
double pixel_angle(const Projection& p, PixelPosition pixel);

// Returns an upper bound, over all directions, of the relative change of the image's scale per
// radian.  This is the logarithmic derivative of the angle that a pixel covers, or the curvature of
// the circles of latitude.  It grows without bound towards a pole or the back of a fisheye.
double scale_change_per_radian(const Projection& p, const CameraDirection& n);

// Says whether the area of a row's pixels may vary notably within a pixel.
bool has_slanted_areas(const Projection& p, int row);

// Returns the box of the cap of this angle (radians) about n, or nothing if it lies outside the
// circle about Z that holds the whole image.
std::optional<CapBox> cap_box(const Projection& p, const CameraDirection& n, double angle);
CapSpans spans_of(const Projection& p, const CapPlace& cap, int row, const ColumnRange& inside);

// A CubemapFace is an image of its own without a seam.  It has its top left pixel on the cube's net,
// counted from 0, its own projection, and the axes X, Y, Z of its camera in that of the whole net.
struct CubemapFace {
  int column, row;
  Projection projection;
  std::array<Imath::V3d, 3> axes;
};

// Returns the faces in the order of Cubemap::axes(), and none for the other projections.
// They have no seam, or continue beyond it as one function of the pixel.
std::vector<CubemapFace> cubemap_faces(const Projection& p);

}  // namespace domefall
