// Where a view ray meets a disc, in closed form: exact_position at the angles of the plane.
#pragma once

#include <cmath>
#include <numbers>

#include "pipeline/light/aberration.h"
#include "pipeline/light/ray_position.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {

// The angle psi_0 in (0, pi] at which a ray first meets the plane through the hole with this
// normal.
inline double first_crossing(const V3d& place, const V3d& tangent, const V3d& normal) {
  const double psi = std::atan2(-normal.dot(place), normal.dot(tangent));
  return psi > 0 ? psi : psi + std::numbers::pi;  // for observers who are not in the plane
}

// An observer on the axis R = (1, 0, 0), in the tetrad's components (R, Theta, Phi).
inline const V3d kPlace{1, 0, 0};

// The unit tangent at the azimuth chi about the axis to the hole.
inline V3d tangent_at(double chi) { return {0, std::cos(chi), std::sin(chi)}; }

// A normal whose angle with the observer's place is `inclination` and whose near side of the disc
// lies at chi = 0.
inline V3d normal_at(double inclination) {
  return {std::cos(inclination), -std::sin(inclination), 0};
}

// k.u of the observer at rest over that of radial free fall at the same place, for a ray at delta
// from the hole's direction in the frame at rest: by the boost that the renderer uses.
inline double frequency_at_rest(double r, double delta) {
  const double s = std::sqrt(2 / r);
  const V3d celerity(s / std::sqrt(1 - s * s), 0, 0);
  return 1 / to_tetrad(celerity, V3d(-std::cos(delta), std::sin(delta), 0)).frequency_ratio;
}

// 1 + z of the disc at r for an observer at rest at `at`, on the ray at delta and chi.
inline double shift_at_rest(double at, double delta, double chi, const V3d& normal, double r) {
  const NullRay ray = ray_at(at, delta, {false, true});
  return disc_shift(GasOrbits(), disc_ray(invariants(ray), kPlace, tangent_at(chi), normal), r,
                    true) /
         frequency_at_rest(at, delta);
}

}  // namespace domefall
