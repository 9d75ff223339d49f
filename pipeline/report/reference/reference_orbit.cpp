#include "pipeline/report/reference/reference_orbit.h"

#include <boost/math/quadrature/gauss.hpp>

namespace domefall {
namespace {

using Rule = boost::math::quadrature::gauss<Real50, 20>;

struct Gained {
  Real50 tau = 0, azimuth = 0;
};

// Returns the gain from r = from + sign low^2 to r = from + sign high^2, by 20 Gauss points.  With
// r = from + sign x^2, |dr| = 2 x dx.
Gained gained(const ReferenceOrbit& orbit, const Real50& from, int sign, const Real50& low,
              const Real50& high) {
  Gained sums;
  const Real50 middle = (low + high) / 2, half = (high - low) / 2;
  const auto add = [&](const Real50& node, const Real50& weight) {
    const Real50 x = middle + half * node, r = from + sign * x * x;
    const Real50 rate = 2 * x * half * weight / orbit.radial_speed(r);
    sums.tau += rate;
    sums.azimuth += rate * orbit.angular_momentum / (r * r);
  };
  // Boost keeps the positive half of the nodes, since the rule is even.
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
    add(Rule::abscissa()[k], Rule::weights()[k]);
    add(-Rule::abscissa()[k], Rule::weights()[k]);
  }
  return sums;
}

}  // namespace

Real50 ReferenceOrbit::energy() const { return sqrt(Real50(1 + excess_energy)); }

Real50 ReferenceOrbit::radial_speed(const Real50& r) const {
  // This is u^2 of reference_orbit.h, with 2/r - L^2/r^2 + 2 L^2/r^3 written as
  // w (2 - L^2 w^2 (r - 2)).
  const Real50 w = 1 / r, lw = angular_momentum * w;
  return sqrt(Real50(excess_energy + w * (2 - lw * lw * (r - 2))));
}

// With w = 1/r, E^2 = (1 - 2w)(1 + L^2 w^2) at a turning point.  The difference of this equation at
// a and at b, divided by a - b, is 0 = -2 + L^2 (a + b) - 2 L^2 (a^2 + ab + b^2), which gives L^2.
ReferenceOrbit orbit_between(const Real50& near, const Real50& far) {
  const Real50 a = 1 / near, b = isinf(far) ? Real50(0) : Real50(1 / far);
  const Real50 l2 = 2 / (a + b - 2 * (a * a + a * b + b * b));
  return {(1 - 2 * a) * (1 + l2 * a * a) - 1, sqrt(l2)};
}

// Each interval between neighbouring radii is integrated by itself, and the gains are added up.
std::vector<ReferencePlace> reference_leg(const ReferenceOrbit& orbit, const Real50& from,
                                          const std::vector<Real50>& radii) {
  std::vector<ReferencePlace> places;
  places.reserve(radii.size());
  Real50 low = 0, tau = 0, azimuth = 0;
  for (const Real50& r : radii) {
    const int sign = r > from ? 1 : -1;
    const Real50 high = sqrt(Real50(sign * (r - from)));
    const Gained step = gained(orbit, from, sign, low, high);
    tau += step.tau, azimuth += step.azimuth, low = high;
    places.push_back({tau, r, azimuth});
  }
  return places;
}

}  // namespace domefall
