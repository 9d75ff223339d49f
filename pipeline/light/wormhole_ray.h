// A ray in a wormhole as its observer knows it, and integrals along its WormholeLeg.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>

#include "pipeline/spacetime/wormhole_leg.h"

namespace domefall {

// The throat's view has this angle.  Its cosine vanishes at the throat and keeps its digits there.
struct EdgeAngle {
  double sine, cosine;
};
EdgeAngle edge_angle(const Wormhole& wormhole, double l);

// A ray at an offset (radians) beyond the edge delta_e, as in wormhole_azimuth.h.
struct ThroatRay {
  double r;             // of the observer
  double b, below;      // b and 1 - b
  double sine, cosine;  // of delta
  bool inward, passes;  // towards the throat at first; through it

  // Returns the u of the observer, and that of a place at l on the leg, given r - 1 there.
  double start(const WormholeLeg& leg, double beyond_mouth) const {
    // r - b = r (1 - sin(delta)) does not cancel this way.
    return leg.parameter(beyond_mouth, r * cosine * cosine / (1 + b / r));
  }
};
ThroatRay throat_ray(const Wormhole& wormhole, double l, double offset);

// Returns the integral of rate(place) du over a part of a leg in which it is smooth, 0 <= low <= high.
// Beyond the leg's calm() it must fall like exp(-u).  Measured, it is right to rounding by 20 nodes a
// panel, and by 12 to 1e-11.
template <unsigned kNodes = 20, class Rate>
double along_leg(const WormholeLeg& leg, double low, double high, const Rate& rate) {
  using Rule = boost::math::quadrature::gauss<double, kNodes>;
  constexpr double kPanel = 2.5;  // of u, over which the rate is smooth as far as pi/2 off the axis
  constexpr double kGrowth = 2.2;  // three panels more than a width that stays
  const double calm = leg.calm();
  double sum = 0, width = kPanel;
  for (double u = low; u < high; u += width) {
    if (u > calm + kPanel) width *= kGrowth;
    sum +=
        Rule::integrate([&](double at) { return rate(leg.at(at)); }, u, std::min(u + width, high));
  }
  return sum;
}

}  // namespace domefall
