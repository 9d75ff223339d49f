#include "pipeline/light/wormhole_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/light/wormhole_azimuth.h"

namespace domefall {
namespace {

SkyRegion sky_of_side(Region side) {
  return side == Region::kIII ? SkyRegion::kIII : SkyRegion::kI;
}

// Azimuths have structure where alpha is of the edge's size, where 1 - b is of the size of m, and,
// next to the throat, where the rays begin to go outward.  What is smaller than the last number is
// smaller than anything that is seen.
double least_angle(const Wormhole& wormhole, double alpha, double l) {
  const double m = wormhole.lensing_mass();
  double least = std::min(1.0, alpha);
  if (wormhole.profile == Wormhole::Profile::kDngr) least *= std::min(1.0, m);
  const double above = wormhole.above_throat(l);
  return above > 0 ? std::min(least, std::max(1e-5, std::sqrt(2 * above))) : least;
}

// Returns the zone of the own side's sky (sign 1), or of the other side's (-1).
SkyZone zone_of(const Wormhole& wormhole, double l, double sign) {
  const HalfAngle edge = throat_edge(wormhole, l);
  SkyZone zone;
  zone.edge = {edge, sign};
  zone.reach = sign > 0 ? std::numbers::pi - edge.angle() : edge.angle();
  zone.least = least_angle(wormhole, edge.angle(), l);
  zone.logarithm = 1 / std::sqrt(wormhole.curvature_at_throat());
  zone.uneven = true;
  zone.inward = l < 0 ? -1 : 1;
  zone.azimuth = [=](double offset) { return wormhole_azimuth(wormhole, l, sign * offset); };
  if (wormhole.in_cylinder(l) || (sign < 0 && wormhole.half_length() > 0))
    zone.winding = [=](double offset) { return cylinder_azimuth(wormhole, l, sign * offset); };
  zone.ray = [=](double offset) {
    const double s = std::sin(offset / 2) * sign, c = std::cos(offset / 2);
    return ZoneRay{{std::max(0.0, edge.sine * c + edge.cosine * s),
                    std::max(0.0, edge.cosine * c - edge.sine * s)},
                   1};
  };
  return zone;
}

}  // namespace

HoleOptics make_wormhole_optics(const Wormhole& wormhole, const ObserverState& observer) {
  const Region side = Wormhole::side(observer.l);
  HoleOptics optics;
  optics.tetrad = observer.tetrad;
  optics.inward = observer.l < 0 ? -1 : 1;
  optics.parts.push_back({sky_of_side(side), zone_of(wormhole, observer.l, 1), {}});
  optics.parts.push_back({sky_of_side(mirror_of(side)), zone_of(wormhole, observer.l, -1), {}});
  return optics;
}

}  // namespace domefall
