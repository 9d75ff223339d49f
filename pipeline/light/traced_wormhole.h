// trace_wormhole() gives one ray in a wormhole by numbers, for an observer at rest.  `domefall trace`
// prints this, and the reference rays are compared with it.
#pragma once

#include <optional>
#include <string_view>

#include "pipeline/spacetime/wormhole.h"

namespace domefall {

// A WormholeRequest gives delta (radians) from the direction of the throat.  It is the edge's plus
// the offset.
struct WormholeRequest {
  Wormhole wormhole;
  double l = 0;  // radii of the throat
  double delta = 0, offset = 0;
};

// A WormholePlace says where an observer is, in any unit of length: the throat's radius rho, half of
// the cylinder's length a and the mass m, which ellis does not have, and l.
struct WormholePlace {
  std::string_view profile;  // ellis or dngr
  long double rho = 1;
  std::optional<long double> a, m;
  long double l = 0;
};

// These make a request, and throw InputError for what is no ray.  rho must be above 0, a/rho from 0
// to 1e12, m/rho from 1e-30 to 1e30, and l/rho from -1e12 to 1e12.  delta must be from 0 to pi, and
// `edge` throat.
WormholeRequest wormhole_ray_at_angle(const WormholePlace& place, long double delta);
WormholeRequest wormhole_ray_at_edge(const WormholePlace& place, std::string_view edge,
                                     double offset);

struct TracedWormhole {
  bool own;              // from the sky of the side of l; l = 0 counts as l > 0
  double azimuth;        // swept, radians; infinite on the edge, where light comes from neither sky
  double slope;          // d azimuth/d delta, signed; infinite on the edge
  double amplification;  // sin(delta)/|sin(azimuth) slope|; 0 on the edge
};
// Traces a ray, by what renders frames (`tables`, which are kept from one call to the next while the
// observer stays the same, in each thread) or by the exact integral.
TracedWormhole trace_wormhole(const WormholeRequest& request, bool tables);

}  // namespace domefall
