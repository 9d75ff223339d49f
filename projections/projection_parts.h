// What projections are made of.  Each is a structure in a file of its own, and projection.h lists
// them.  A new one says at least
//
//     static constexpr ProjectionTraits kTraits;
//     CameraDirection direction(Centred at) const;                      // finite everywhere
//     std::optional<Centred> place(const CameraDirection& n) const;     // its inverse
//     double largest_pixel_angle() const;      // radians; no pixel of the image covers more
//
// and has either the members `columns` and `rows`, or the functions width(), height() and
// with_sides(columns, rows).  Where it says none of the following, what stands in is right, but
// slower (projection_defaults.h).
//
//     double fov;                              // its opening angle in radians, if a show may set it
//     double cut_back;                         // of a dome lower than wide, see Fisheye
//     double pixel_aspect;                     // of pixels that need not be square, see Centred
//     AngularScales scales(Centred at) const;  // of a projection about Z, or for others
//     PixelMetric metric(Centred at) const;    // instead of differences of directions
//     double solid_angle(Centred at) const;    // what follows from the metric
//     double pixel_angle(Centred at) const;    // likewise
//     double scale_change(const CameraDirection& n) const;  // unbounded: all blobs are caps
//     bool shows(Centred at) const;            // a dome its circle, others everything; each row's
//                                              // pixels that it shows are neighbours
//     CapBox cap_box(const CameraDirection& n, double angle) const;  // places along its rim
//     CapSpans cap_spans(const CapPlace& cap, PixelPosition origin, int row,
//                        const ColumnRange& inside) const;           // all of the box
//     bool has_slanted_areas(int row) const;   // true
//     V view() const;                          // no SIMD: direction, pixel_angle and solid_angle
//
// A view V is a structure of few numbers for loops over many places (x, y) = Centred.  Its formulas
// have neither a branch nor a library function, so that they become SIMD code:
//
//     CameraDirection direction(double x, double y) const;
//     double pixel_angle(double x, double y) const;
//     double area(const CameraDirection& n, double x, double y) const;  // of a pixel, in any unit
#pragma once

#include <Imath/ImathVec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace domefall {

// A CameraDirection is a unit vector with components along the camera's X, Y, Z.
struct CameraDirection {
  Imath::V3d v;
};

struct PixelPosition {
  double i, j;
};

// A Centred place is given from the middle of the image, or from the pixel that looks along Z on
// images about that axis (origin_of in projection.h), in pixels.  Where these are not square it is
// in widths of a pixel along both axes, so that formulas of a projection know square pixels only:
// the rows of [Riazuelo] eq. pix_j are rescaled where a place becomes a pixel (centred() and
// uncentred() in projection_defaults.h).
struct Centred {
  double x, y;
};

// ProjectionTraits are what distinguishes a projection for its users.
struct ProjectionTraits {
  std::string_view name;
  bool has_zenith = false;     // Z is an audience's zenith, and not where a camera looks
  bool is_dome = false;        // it shows only its circle about the zenith, with the front below
  bool half_sphere = false;    // its circle is a half sphere and touches all four edges
  bool has_seam = false;       // its left and right edge are one meridian
  bool has_faces = false;      // it consists of several images (cubemap_faces)
  bool keeps_circles = false;  // a circle on the sphere is a circle in the image
  bool keeps_lines = false;    // a straight line in space is a straight line in the image
  double shown_deg = 0;        // the angle that it shows, or 0 where that is free (field_of_view)
  double usual_deg = 0;        // that angle where a show says nothing
  double widest_deg = 0;       // and where it ends
  bool below_widest = false;   // the widest is not reached
  // Why one number of pixels gives the size of an image, and what takes that number; empty where a
  // width and a height do, which fisheyes may have, too.
  std::string_view one_number = {}, taker = {};
  int in_width = 1;   // how many times the number stands in the width
  bool even = false;  // the number is even
  // What it is and how it is turned, for who receives the frames.  {} is the field of view (deg).
  std::string_view description, orientation = {};
};
inline constexpr std::string_view kDomeOrientation =
    "BOTTOM of the picture = FRONT of the dome. Left and right are those\n"
    "of the audience: nothing is mirrored.";

// A PixelMetric says how a projection scales at a place.  A small step of (dx, dy) pixels turns the
// direction by the square root of xx dx^2 + 2 xy dx dy + yy dy^2, in radians.
struct PixelMetric {
  double xx, xy, yy;
};

// AngularScales are the angles that a pixel covers along the direction to the middle, and across
// it, both at least 0.
struct AngularScales {
  double radial, tangential;
};

// Returns the metric of a projection about Z.
inline PixelMetric metric_about_z(const AngularScales& s, Centred at) {
  const double r2 = at.x * at.x + at.y * at.y, across = s.tangential * s.tangential;
  const double more = r2 > 0 ? (s.radial * s.radial - across) / r2 : 0;
  return {across + more * at.x * at.x, more * at.x * at.y, across + more * at.y * at.y};
}

// A ColumnRange has the pixels of a row (from 0) whose centres are inside.  These are columns
// first..last (from 0), and none if first > last.
struct ColumnRange {
  int first, last;
};

// A cap is all directions within an angle of one.  A CapBox says how far, in pixels, the box around
// a cap reaches from the middle of the cap, and within which distance of it all of the cap lies.
struct CapBox {
  double left, right, up, down;
  double reach;
};
inline CapBox square_box(double half) { return {half, half, half, half, half}; }
inline constexpr double kWholeImage = 1e9;  // more pixels than any image has

// A CapPlace is a cap in an image: its middle in pixels from 0, its angle, and what bounds it.
struct CapPlace {
  double x, y;
  double angle;  // radians
  double reach;  // as in CapBox
  int first_column, last_column;
};

// CapSpans are the columns, within those of the image, that a cap may cover on one row.  There
// are several spans where the cap lies on a ring about the middle of a fisheye, or on both sides of
// a seam.
struct CapSpans {
  std::array<ColumnRange, 3> span;
  std::size_t count = 0;

  // Adds the columns between two positions in a row that are within `inside`.
  void add(double from, double to, const ColumnRange& inside) {
    const int first = static_cast<int>(std::max(std::floor(from), double(inside.first)));
    const int last = static_cast<int>(std::min(std::ceil(to), double(inside.last)));
    if (first <= last) span[count++] = {first, last};
  }
};

// RowPart is what a cap's circle of `reach` and its columns leave of a row, from the left to the
// right, in pixels from 0.
struct RowPart {
  double left, right;
};
inline std::optional<RowPart> part_of_row(const CapPlace& cap, int row) {
  const double dy = row - cap.y, half2 = cap.reach * cap.reach - dy * dy;
  if (half2 < 0) return std::nullopt;
  return RowPart{std::max(cap.x - std::sqrt(half2), double(cap.first_column)),
                 std::min(cap.x + std::sqrt(half2), double(cap.last_column))};
}

inline double angle_to_middle(const CameraDirection& n) {
  return std::atan2(std::hypot(n.v.x, n.v.y), n.v.z);
}

// Returns the place of a direction on an image about Z that has so many pixels for a unit of
// (X.N, Y.N).  There is none if these are infinite.
inline std::optional<Centred> place_about_z(double magnification, const CameraDirection& n) {
  if (!std::isfinite(magnification)) return std::nullopt;
  return Centred{magnification * n.v.x, magnification * n.v.y};
}

// Returns the tangent of an angle to an axis, from the components along the axis and across it.
// From a right angle on it is kEndlessChange.
inline constexpr double kEndlessChange = 1e30;
inline double tangent_or_endless(double along, double across) {
  return along > 0 ? across / along : kEndlessChange;
}

}  // namespace domefall
