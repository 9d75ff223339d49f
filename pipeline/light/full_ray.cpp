// The second-order sets are integrated here by Boost.Odeint's controlled steppers.

#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <limits>
#include <optional>

#include "pipeline/light/follow_ray.h"
#include "pipeline/light/scaled_step_control.h"

namespace domefall {
namespace {

namespace odeint = boost::numeric::odeint;

// GCC 14 does not see that Odeint finds the derivative in the first step, before it is used.
#pragma GCC diagnostic push
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
template <class ErrorStepper>
class OdeintStepper {
 public:
  explicit OdeintStepper(double tolerance) : tolerance_(tolerance) {}

  void restart(const GeodesicEquations& equations) {
    stepper_.emplace(ScaledErrorChecker(equations, tolerance_),
                     typename Stepper::step_adjuster_type(), blank_stepper<ErrorStepper>());
  }

  bool try_step(const GeodesicEquations& equations, RayState& y, double& h) {
    double parameter = 0;  // the equations do not depend on it
    return stepper_->try_step(equations, y, parameter, h) == odeint::success;
  }

  // The step is at most a radian, so that no step grows without bound on the light circle.
  static double largest_step(const GeodesicEquations& /*equations*/, const RayState& y) {
    return 1 / (y[kAzimuthRate] + std::numeric_limits<double>::min());
  }

 private:
  using Stepper = ScaledStepper<ErrorStepper, GeodesicEquations>;
  double tolerance_;
  std::optional<Stepper> stepper_;
};
#pragma GCC diagnostic pop

}  // namespace

IntegratedRay full_ray_dopri5(const PhotonAtObserver& photon, double tolerance, double until) {
  return follow_ray<OdeintStepper<odeint::runge_kutta_dopri5<RayState>>>(photon, tolerance, until);
}

IntegratedRay full_ray_rkf78(const PhotonAtObserver& photon, double tolerance, double until) {
  return follow_ray<OdeintStepper<odeint::runge_kutta_fehlberg78<RayState>>>(photon, tolerance,
                                                                             until);
}

}  // namespace domefall
