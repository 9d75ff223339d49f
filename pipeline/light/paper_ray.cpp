// The paper's own method ([Riazuelo] sec. sec_cel1, ssec_max) is Runge-Kutta of fourth order with
// the step doubled to tell its error, after Numerical Recipes, and a bound on the step by place.
// What the paper leaves open is chosen here.  This is the factors of its step rules, and the radii
// at which the charts change (charted_ray.h), by place and not by what E and L let expect.  Below
// r = 1/2, where Kruskal's coordinates lose r, Schwarzschild's serve in regions II and IV as well.

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/light/follow_ray.h"
#include "pipeline/light/scaled_step_control.h"

namespace domefall {
namespace {

RayState state_after(const RayState& y, double h, const RayState& dy) {
  RayState out;
  for (std::size_t i = 0; i < y.size(); ++i) out[i] = y[i] + h * dy[i];
  return out;
}

// Makes one classical step.  dy is the derivative at y.
RayState classical_step(const GeodesicEquations& equations, const RayState& y, const RayState& dy,
                        double h) {
  RayState k2, k3, k4, out;
  equations(state_after(y, h / 2, dy), k2, 0);
  equations(state_after(y, h / 2, k2), k3, 0);
  equations(state_after(y, h, k3), k4, 0);
  for (std::size_t i = 0; i < y.size(); ++i)
    out[i] = y[i] + h / 6 * (dy[i] + 2 * (k2[i] + k3[i]) + k4[i]);
  return out;
}

class DoublingRk4 {
 public:
  explicit DoublingRk4(double tolerance) : tolerance_(tolerance) {}

  static void restart(const GeodesicEquations& /*equations*/) {}

  bool try_step(const GeodesicEquations& equations, RayState& y, double& h) const {
    constexpr double kSafety = 0.9, kShrinkAtMost = 0.2, kGrowAtMost = 5;
    constexpr double kExtrapolate = 1.0 / 15;  // of the difference of one step and two halves
    RayState dy, middle_dy, error;
    equations(y, dy, 0);
    const RayState middle = classical_step(equations, y, dy, h / 2);
    equations(middle, middle_dy, 0);
    const RayState fine = classical_step(equations, middle, middle_dy, h / 2);
    const RayState coarse = classical_step(equations, y, dy, h);
    for (std::size_t i = 0; i < y.size(); ++i) error[i] = fine[i] - coarse[i];
    const double share = scaled_error(error, equations.scale(y, dy, h), tolerance_);
    if (share > 1) {
      h *= std::max(kSafety * std::pow(share, -0.25), kShrinkAtMost);
      return false;
    }
    y = state_after(fine, kExtrapolate, error);
    h *= std::min(kSafety * std::pow(share, -0.2), kGrowAtMost);
    return true;
  }

  // These are the paper's step rules, in which lengths are r over the coordinate speed.  Beyond 4 a
  // receding ray steps in proportion to r^2, so that a handful of steps reach infinity.  An
  // approaching one steps to r - 4, and within 4 a step is a small part of r.  In Kruskal's chart
  // no rule is needed, because it is crossed in no more than a radian.
  static double largest_step(const GeodesicEquations& equations, const RayState& y) {
    constexpr double kLightCircleZone = 4, kReceding = 0.25, kApproaching = 0.5, kWithin = 0.1;
    const double tiny = std::numeric_limits<double>::min();
    if (equations.chart == Chart::kKruskal) return 1 / (y[kAzimuthRate] + tiny);
    const double r = y[1];
    const double speed = std::abs((1 - 2 / r) * y[3]) + std::abs(y[4]) + r * y[kAzimuthRate];
    if (r <= kLightCircleZone) return kWithin * r / speed;
    if (y[4] > 0) return kReceding * r * r / speed;
    return std::max(kApproaching * (r - kLightCircleZone), kWithin * r) / speed;
  }

 private:
  double tolerance_;
};

}  // namespace

IntegratedRay paper_ray(const PhotonAtObserver& photon, double tolerance, double until) {
  return follow_ray<DoublingRk4>(photon, tolerance, until);
}

}  // namespace domefall
