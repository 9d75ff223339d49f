#include "pipeline/show/orbital_elements.h"

#include <cmath>
#include <numbers>

#include "pipeline/show/placement.h"
#include "trajectories/bound_orbit.h"

namespace domefall {
namespace {

// Returns p = a (1 - e^2), where a follows from Kepler's third law.  With M = 1 that law is a^3 =
// (period/2 pi)^2, and 1 - e^2 is a product that keeps its digits next to e = 1.
double semi_latus_rectum(const OrbitalElements& elements) {
  const double e = elements.eccentricity;
  return std::pow(elements.period / (2 * std::numbers::pi), 2.0 / 3) * (1 - e) * (1 + e);
}

}  // namespace

// With N, E and Z to the north, to the east and away from us, the body is at
//     N: r (cos Omega cos u - sin Omega sin u cos i),
//     E: r (sin Omega cos u + cos Omega sin u cos i),
//     Z: r sin u sin i,
// where u is its angle from the node.  These are the rotations by u, i and Omega, one after the
// other.
void set_orbit(const OrbitalElements& elements, const SkyDirection& line_of_sight, Body& body) {
  body.trajectory = bound_by_shape(semi_latus_rectum(elements), elements.eccentricity);
  body.start = 0;
  // The tangents of the sky there are found like those at an observer's own place (placement.h).
  const M33d sky = place_tetrad({-line_of_sight.v}, std::numbers::pi / 2, 0);
  const V3d away = column(sky, 0), north = -column(sky, 1), east = column(sky, 2);
  const double cos_i = std::cos(elements.inclination), sin_i = std::sin(elements.inclination);
  const double cos_node = std::cos(elements.node), sin_node = std::sin(elements.node);
  const V3d node = north * cos_node + east * sin_node;
  const V3d onward = (east * cos_node - north * sin_node) * cos_i + away * sin_i;
  body.node = {node.normalized()};
  body.normal = {node.cross(onward).normalized()};
  body.azimuth = elements.pericentre;
}

}  // namespace domefall
