// The centre of a sphere in the slices of free fall (sphere_surface.h).
#pragma once

#include "pipeline/light/body_image.h"
#include "pipeline/spacetime/spacetime.h"

namespace domefall {

// The frame of free fall has these components along v and r: u of its time, and e of R.
struct FallFrame {
  double u_v, u_r, e_v, e_r;
  // The time T of a slice grows along u by this.
  double time_along_u() const { return u_v - e_v * u_r / e_r; }
};

inline FallFrame fall_frame(const Spacetime& spacetime, double r) {
  if (spacetime.is<ChargedHole>()) {
    const double f = spacetime.lapse_squared(r);
    return {1, (f - 1) / 2, 1, (1 + f) / 2};
  }
  const double s = Schwarzschild::free_fall_speed(r);
  return {1 / (1 + s), -s, 1 / (1 + s), 1};
}

// Returns by how much v differs from one r to another within a slice, by Simpson's rule.
inline double slice_of_v(const Spacetime& spacetime, double from, double to) {
  constexpr int kSteps = 8;
  double sum = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const FallFrame frame = fall_frame(spacetime, from + (to - from) * k / kSteps);
    sum += frame.e_v / frame.e_r * (k == 0 || k == kSteps ? 1 : k % 2 == 1 ? 4 : 2);
  }
  return sum * (to - from) / (3 * kSteps);
}

// A SphereCentre is the centre of a sphere at one time of its own.
struct SphereCentre {
  SphereCentre(const Spacetime& spacetime, const BodyPoint& point)
      : at(point),
        celerity(point.celerity()),
        frame(fall_frame(spacetime, point.r)),
        place(point.direction * point.r) {}

  // Makes lengths along R differences of r, or the other way round.
  V3d scaled(const V3d& v, double factor) const {
    return v + at.direction * (at.direction.dot(v) * (factor - 1));
  }
  V3d contracted(const V3d& q) const {
    return q - celerity * (celerity.dot(q) / (at.gamma * (at.gamma + 1)));
  }
  V3d stretched(const V3d& d) const { return d + celerity * (celerity.dot(d) / (at.gamma + 1)); }
  V3d own(const V3d& x) const { return stretched(scaled(x - place, 1 / frame.e_r)); }  // q
  double time_rate() const { return at.gamma * frame.time_along_u(); }                 // dT/dtau
  V3d motion() const {                                                                 // dX/dT
    const double radial = at.gamma * frame.u_r + at.radial * frame.e_r;
    const V3d across = celerity - at.direction * at.radial;
    return (at.direction * radial + across) / time_rate();
  }

  BodyPoint at;
  V3d celerity;
  FallFrame frame;
  V3d place;
};

}  // namespace domefall
