// Finds the turning points of orbits near a charge with 50 digits, in which roots that are close to
// each other stay apart.
#pragma once

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <vector>

#include "trajectories/charged_orbit.h"

namespace domefall {

using Wide = boost::multiprecision::cpp_bin_float_50;
using WidePolynomial = std::vector<Wide>;  // coefficients of rising powers

// Other roots that are as close to a turning point as this part of it are not told from it.
inline const Wide kRootBeside("1e-23");

Wide value(const WidePolynomial& p, const Wide& x);

template <class Function>
Wide wide_zero(const Function& f, const Wide& low, const Wide& high) {
  const Wide at_low = f(low), at_high = f(high);
  if (at_low == 0 || (at_low > 0) == (at_high > 0)) return low;
  constexpr int kBits = 160;
  std::uintmax_t steps = 1000;
  const auto found = boost::math::tools::toms748_solve(
      f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<Wide>(kBits), steps);
  return (found.first + found.second) / 2;
}

// Returns the real roots in their order.  Double roots may be missed, or given once.
std::vector<Wide> roots_of(WidePolynomial p);

// A WideSpace holds q^2 and what follows from it.
struct WideSpace {
  ChargedHole hole;
  Wide q2;

  explicit WideSpace(const ChargedHole& of) : hole(of) {
    const Wide q(of.charge_long());
    q2 = q * q;
  }
  Wide f(const Wide& w) const { return 1 + w * (q2 * w - 2); }
};

struct WideConstants {
  Wide excess, l2;  // E^2 - 1, L^2
};

WidePolynomial radial_polynomial(const WideSpace& s, const WideConstants& c);

// Holds the turning points with their 50 digits, too.
struct WideTurns {
  ChargedTurns turns;
  Wide w1, w2;

  double above(const Wide& w) const { return static_cast<double>(1 / w - 1 / w2); }
  double below(const Wide& w) const {
    return w1 > 0 ? static_cast<double>(1 / w1 - 1 / w) : kInfinity;
  }
};

WideTurns turns_between(const WideSpace& s, const WideConstants& c, const Wide& w1, const Wide& w2);
// Returns the root next to w, above it or below.
Wide next_root(const WidePolynomial& p, const Wide& w, bool above);
// Returns the turning points on both sides of a place where the orbit moves.
WideTurns turns_about(const WideSpace& s, const WideConstants& c, const Wide& w);
// Returns those of an orbit that turns at w, or circles there.
WideTurns turns_from(const WideSpace& s, const WideConstants& c, const Wide& w);

}  // namespace domefall
