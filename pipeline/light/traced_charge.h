// trace_charge() gives one ray near a charge by numbers, for an observer who moves as the tetrad T.
// `domefall trace` prints this, and the reference rays are compared with it.
#pragma once

#include <optional>
#include <string_view>

#include "pipeline/light/charged_azimuth.h"

namespace domefall {

// A ChargedRequest gives delta (radians) from -R, which is the direction of the hole.  If an edge is
// given, delta = edge + offset to full accuracy instead.
struct ChargedRequest {
  ChargedHole hole;
  ChargedRadius at;
  long double delta = 0;
  std::optional<Critical> edge;
  double offset = 0;
};

// These make a request, and throw InputError for what is no ray.  q must be from 0 to 100, r from
// 1e-3 of the innermost mark of the hole (r_-, or q^2 without horizons) to 1e12 (M), and off an
// inner horizon.  `edge` is silhouette, inner (beyond a dark ring) or region3, as far as there is
// one at r.
ChargedRequest charged_ray_at_angle(long double charge, long double r, long double delta);
ChargedRequest charged_ray_at_edge(long double charge, long double r, std::string_view edge,
                                   double offset);

struct TracedCharge {
  double delta;
  ChargedOrigin origin;
  double phi;     // swept azimuth, radians; infinite for a ray that comes from nowhere
  double energy;  // signed; its absolute value is emitted / observed frequency
  double angular_momentum;
  double slope;          // d phi/d delta, signed
  double amplification;  // sin(delta)/|sin(phi) slope|; 0 without an origin
};
TracedCharge trace_charge(const ChargedRequest& request);

}  // namespace domefall
