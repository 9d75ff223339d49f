#include "pipeline/light/wormhole_zones.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

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

}  // namespace

double WormholeZone::azimuth(double distance) const {
  return wormhole_azimuth(wormhole, l, sign * distance);
}

double WormholeZone::bent_azimuth(double distance) const {
  Wormhole bent = wormhole;
  bent.length = 0;
  return wormhole_azimuth(bent, std::copysign(wormhole.beyond_mouth(l), l), sign * distance);
}

double WormholeZone::straight_azimuth(double distance) const {
  return cylinder_azimuth(wormhole, l, sign * distance);
}

double WormholeZone::distance_of(double phi) const {
  // In the logarithm of the distance a law of logarithms is a straight line, and a power is convex.
  const auto off = [&](double log_distance) { return azimuth(std::exp(log_distance)) - phi; };
  double high = std::log(reach), low = high - 1, at_high = -phi, at_low = off(low);
  while (at_low < 0) {
    high = low, at_high = at_low;
    low -= 4;
    at_low = off(low);
  }
  std::uintmax_t steps = 100;
  const auto found = boost::math::tools::toms748_solve(
      off, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(50), steps);
  return std::exp((found.first + found.second) / 2);
}

double WormholeZone::einstein_ring(int half_turns) const {
  return distance_of(half_turns * std::numbers::pi);
}

std::array<WormholeZone, 2> wormhole_zones(const Wormhole& wormhole, double l) {
  const HalfAngle edge = throat_edge(wormhole, l);
  const double alpha = 2 * std::atan2(edge.sine, edge.cosine);
  const double logarithm = 1 / std::sqrt(wormhole.curvature_at_throat());
  const double least = least_angle(wormhole, alpha, l);
  const Region side = Wormhole::side(l);
  return {{{wormhole, l, sky_of_side(side), edge, 1, std::numbers::pi - alpha, least, logarithm},
           {wormhole, l, sky_of_side(mirror_of(side)), edge, -1, alpha, least, logarithm}}};
}

}  // namespace domefall
