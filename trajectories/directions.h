// Three kinds of spatial unit vector meet in a picture.  They are separate types because mixing
// them compiles to a plausible picture that is wrong.
#pragma once

#include <Imath/ImathMatrix.h>
#include <Imath/ImathVec.h>

namespace domefall {

using Imath::M33d;
using Imath::V3d;

// A SkyDirection is a direction on the celestial sphere at infinity, of unit length.  It is
// equatorial J2000 Cartesian, with x towards RA 0h Dec 0, y towards RA 6h Dec 0, and z towards the
// north celestial pole.
struct SkyDirection {
  V3d v;
};

// A TetradDirection is a direction in the space of the reference tetrad, of unit length, with
// components along (R, Theta, Phi).  The hole is at (-1, 0, 0).
struct TetradDirection {
  V3d v;
};

// Imath multiplies row vectors (v * M).  Domefall writes matrices as three columns, the images of
// the basis vectors, and applies them with this.
inline V3d apply(const M33d& columns, const V3d& v) {
  return {columns[0][0] * v.x + columns[0][1] * v.y + columns[0][2] * v.z,
          columns[1][0] * v.x + columns[1][1] * v.y + columns[1][2] * v.z,
          columns[2][0] * v.x + columns[2][1] * v.y + columns[2][2] * v.z};
}

inline V3d apply_transposed(const M33d& columns, const V3d& v) {
  return {columns[0][0] * v.x + columns[1][0] * v.y + columns[2][0] * v.z,
          columns[0][1] * v.x + columns[1][1] * v.y + columns[2][1] * v.z,
          columns[0][2] * v.x + columns[1][2] * v.y + columns[2][2] * v.z};
}

inline V3d column(const M33d& m, int k) { return {m[0][k], m[1][k], m[2][k]}; }

inline M33d from_columns(const V3d& a, const V3d& b, const V3d& c) {
  return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

}  // namespace domefall
