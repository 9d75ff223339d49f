// This file says how a step is judged, whatever takes it.  The estimated error of each component is
// compared with a scale that the equations give, as Numerical Recipes does, and the largest share
// counts.
#pragma once

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

namespace domefall {

// Returns the largest |error_i| / (tolerance scale_i).  It is enormous, and the step hence refused,
// where a number is not finite because a stage of the step left the domain of the equations.
template <class State>
double scaled_error(const State& error, const State& scale, double tolerance) {
  constexpr double kRefused = 1e30;
  double worst = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double floor = std::numeric_limits<double>::min();
    const double share = std::abs(error[i]) / (tolerance * scale[i] + floor);
    if (!std::isfinite(share)) return kRefused;
    worst = std::max(worst, share);
  }
  return std::min(worst, kRefused);
}

// This is Boost.Odeint's error checker of a set of equations with
//   State scale(const State& y, const State& dy, double h).
template <class Equations>
class ScaledErrorChecker {
 public:
  explicit ScaledErrorChecker(const Equations& equations = {}, double tolerance = 1)
      : equations_(equations), tolerance_(tolerance) {}

  template <class Algebra, class State>
  double error(Algebra& /*algebra*/, const State& y, const State& dy, const State& error,
               double h) const {
    return scaled_error(error, equations_.scale(y, dy, h), tolerance_);
  }

 private:
  Equations equations_;
  double tolerance_;
};

template <class ErrorStepper, class Equations>
using ScaledStepper =
    boost::numeric::odeint::controlled_runge_kutta<ErrorStepper, ScaledErrorChecker<Equations>>;

// Returns the stepper that the above is constructed from.  Odeint copies the stepper it is given
// with all its scratch space, which in a static object is zero, not undefined.
template <class ErrorStepper>
const ErrorStepper& blank_stepper() {
  static const ErrorStepper kBlank;
  return kBlank;
}

}  // namespace domefall
