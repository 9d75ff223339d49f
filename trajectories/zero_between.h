// The zero of a function of one number.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace domefall {

// Returns the zero of a continuous function between low and high, to double precision, or high if
// its values at both have the same sign, as where rounding has moved the zero beyond it.  By
// Alefeld, Potra and Shi's algorithm 748.
template <class Function>
double zero_between(const Function& f, double low, double high) {
  const double at_low = f(low), at_high = f(high);
  if (at_low == 0) return low;
  if ((at_low > 0) == (at_high > 0)) return high;
  std::uintmax_t steps = 200;
  const auto found = boost::math::tools::toms748_solve(
      f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), steps);
  return (found.first + found.second) / 2;
}

}  // namespace domefall
