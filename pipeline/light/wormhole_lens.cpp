#include "pipeline/light/wormhole_lens.h"

#include <algorithm>
#include <cmath>

#include "pipeline/light/wormhole_zones.h"

namespace domefall {
namespace {

SkyZone zone_of(const WormholeZone& of, double inward) {
  SkyZone zone;
  zone.edge = {of.edge, of.sign};
  zone.reach = of.reach;
  zone.least = of.least;
  // In a cylinder light winds as often as it is long, whatever the distance from the edge.
  zone.logarithm = of.wormhole.half_length() > 0 ? 0 : of.logarithm;
  zone.uneven = true;
  zone.inward = inward;
  zone.azimuth = [=](double offset) { return of.azimuth(offset); };
  zone.ray = [=](double offset) {
    const double half = offset / 2, s = std::sin(half) * of.sign, c = std::cos(half);
    return ZoneRay{{std::max(0.0, of.edge.sine * c + of.edge.cosine * s),
                    std::max(0.0, of.edge.cosine * c - of.edge.sine * s)},
                   1};
  };
  return zone;
}

}  // namespace

HoleOptics make_wormhole_optics(const Wormhole& wormhole, const ObserverState& observer) {
  HoleOptics optics;
  optics.tetrad = observer.tetrad;
  optics.inward = observer.l < 0 ? -1 : 1;
  for (const WormholeZone& zone : wormhole_zones(wormhole, observer.l))
    optics.parts.push_back({zone.sky, zone_of(zone, optics.inward), {}});
  return optics;
}

}  // namespace domefall
