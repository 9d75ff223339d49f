// Sky maps are kept on the faces of a cube.  This file says which face a direction meets, and
// where.
//
// Face 2a is the one towards axis a (x, y, z), and face 2a + 1 is opposite.  With (a, b, c) the
// axes in cyclic order, a direction d has u = d_b/|d_a| and v = d_c/|d_a| on both, so opposite
// faces are mirror images.  On a face of n x n, texel (i, j) has its centre at u = (2 i + 1)/n - 1
// and v = (2 j + 1)/n - 1.  Texels are stored row by row, so that row j follows row j - 1.
#pragma once

#include <cmath>

#include "trajectories/directions.h"

namespace domefall {

struct FacePoint {
  int face;     // 2 * axis, + 1 on the negative side
  double u, v;  // in [-1, 1], along the next two axes
};

// Returns the point where a vector, of any length but 0, meets the cube.  An edge belongs to the
// earlier axis.
inline FacePoint face_of(const V3d& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (x >= y && x >= z) return {d.x < 0 ? 1 : 0, d.y / x, d.z / x};
  if (y >= z) return {d.y < 0 ? 3 : 2, d.z / y, d.x / y};
  return {d.z < 0 ? 5 : 4, d.x / z, d.y / z};
}

// Returns a vector, not of unit length, towards a point.  It inverts face_of, and it also holds
// beyond the face's edges.
inline V3d direction_of(const FacePoint& p) {
  const int axis = p.face / 2;
  V3d d;
  d[axis] = p.face % 2 ? -1 : 1;
  d[(axis + 1) % 3] = p.u;
  d[(axis + 2) % 3] = p.v;
  return d;
}

// Returns the centre of texel (i, j) on a face of n x n.  In the border i or j is -1 or n.
inline FacePoint texel_centre(int face, int i, int j, int n) {
  return {face, (2 * i + 1.0) / n - 1, (2 * j + 1.0) / n - 1};
}

// Returns the solid angle (sr) of a texel with its centre at (u, v) of a face of `size`.  A texel's
// area on the face is 4/size^2.  At its distance d = sqrt(1 + u^2 + v^2) from the sphere's centre
// it is seen at an angle of cosine 1/d, and so under 4/size^2/d^3.  This midpoint rule is good to
// 1e-4 at size 64.
inline double texel_solid_angle(int size, double u, double v) {
  const double s = 1 + u * u + v * v;
  return 4.0 / size / size / (s * std::sqrt(s));
}

}  // namespace domefall
