// RayOrbits say where the rays of one observer are after having swept an angle, many at a time, to
// render what is near the hole.  ray_position.h says what a place along a ray is.  This computes
// the same, column by column and without a table, from the angles between the observer and the ends
// of each orbit.
#pragma once

#include <array>

#include "pipeline/light/null_ray.h"

namespace domefall {

// RayColumns hold rays of one observer by half of alpha, the angle of null_ray.h, in columns of the
// same length.  The gaps are those of NullRay.  Without them (null) they are made of the half
// angles, to 1e-16.
struct RayColumns {
  const double* sin_half = nullptr;
  const double* cos_half = nullptr;
  const double* gap_first = nullptr;
  const double* gap_second = nullptr;
};

// RayPlaces hold one place on each of up to kSize rays.
struct RayPlaces {
  static constexpr int kSize = 128;
  using Column = std::array<double, kSize>;
  // r is in units of M.  It is infinite where the ray has ended on a sky, and 0 where it has ended
  // in the singularity.
  alignas(64) Column r;
  alignas(64) Column slope;  // dr/dpsi, signed; 0 where the ray has ended
};

// OrbitColumns hold what stays the same along each ray.
struct OrbitColumns {
  using Column = RayPlaces::Column;
  // This stands for an angle without end.
  static constexpr double kEndless = 1e9;
  alignas(64) Column inverse_b, eps;  // |E|/L, and its square less 1/27
  // These belong to the path through the observer from one end of the orbit to the other.  `left`
  // is the angle to where it leads, and `behind` that from where it would have come.  The others
  // say whether either end is a sky (1) or the singularity (0).
  alignas(64) Column left, behind, to_sky, from_sky;
  alignas(64) Column sense;  // 1, or -1 where E is negative
};

class RayOrbits {
 public:
  static constexpr int kSize = RayPlaces::kSize;

  // Takes count <= kSize rays of an observer at 0 < r < infinity.  They are given in the rain frame
  // (regions I and II) or, `outgoing`, in that of free fall to infinity (I and IV).
  void set(const Radius& at, bool outgoing, const RayColumns& rays, int count);

  int count() const { return count_; }
  const Radius& at() const { return at_; }
  bool is_outgoing() const { return outgoing_; }
  const OrbitColumns& columns() const { return orbits_; }

  // Finds the places after psi[k] >= 0 radians.  A radial ray has ended for every psi > 0, and one
  // with L/|E| < 1e-40 r counts as radial.  Measured against exact_position over 1e-6 <= r <= 1e8
  // and offsets from an edge down to 1e-15, the relative error is below 1e-13 beside what 2e-15
  // max(1, psi) in psi makes of r.  set() takes 70 ns a ray and find() 17 ns (AVX2, g++ 12 -O3).
  void find(const double* psi, RayPlaces& places) const;

 private:
  Radius at_ = 0.0;
  bool outgoing_ = false;
  int count_ = 0;
  OrbitColumns orbits_;
};

// Returns the region of a place along a ray of signed energy E (RayInvariants).  Back in time light
// leaves region II outwards and is in region IV only inwards.  For mirrored observers I and III
// swap.
inline Region region_at(double energy, double r, double slope) {
  if (r > 2) return energy > 0 ? Region::kI : Region::kIII;
  return slope > 0 ? Region::kII : Region::kIV;
}

}  // namespace domefall
