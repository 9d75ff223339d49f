// Follows a ray through its charts with any stepper for the second-order sets.
#pragma once

#include <algorithm>
#include <cmath>

#include "pipeline/light/charted_ray.h"
#include "pipeline/light/ray_methods.h"

namespace domefall {

// Follows a ray to its end, or until it has swept the angle `until`.  A Stepper is constructed from
// the tolerance and has three functions.  The first is called for another chart, or after a step
// was undone.  The second makes one attempt and sets the next h.
//   void restart(const GeodesicEquations&)
//   bool try_step(const GeodesicEquations&, RayState& y, double& h)
//   double largest_step(const GeodesicEquations&, const RayState& y)
template <class Stepper>
IntegratedRay follow_ray(const PhotonAtObserver& photon, double tolerance, double until) {
  constexpr double kFirstStep = 0.01;  // of r, for a photon whose largest component is 1
  constexpr double kRetreat = 0.25;
  // A step covers this part of the way to the wanted angle, so that the angle is reached from
  // below.
  constexpr double kApproach = 0.9, kReached = 1e-14;

  IntegratedRay result = undecided_ray();
  ChartedRay ray = charted_ray(photon);
  const bool stops = std::isfinite(until);
  const NullTimes seen = null_times_of(ray);
  RayGoals goals = goals_of(photon);
  if (stops) goals = {1e15, 1e-10};
  const auto equations_of = [&result](const ChartedRay& at) {
    return GeodesicEquations{at.chart, at.y[1] > 2, &result.evaluations};
  };
  GeodesicEquations equations = equations_of(ray);
  Stepper stepper(tolerance);
  stepper.restart(equations);
  double h = kFirstStep * photon.r;
  for (; result.steps < kRayStepBudget; ++result.steps) {
    if (change_chart(ray)) {
      equations = equations_of(ray);
      stepper.restart(equations);
    }
    const double left = until - ray.y[kAzimuth];
    if (stops && left <= kReached * until) {
      result.phi = until;
      result.r = radius_of(ray);
      const NullTimes there = null_times_of(ray);
      result.passed = {there.v - seen.v, there.u - seen.u};
      return result;
    }
    if (const auto origin = origin_of(ray, goals)) {
      result.origin = origin;
      result.phi = ray.y[kAzimuth] + azimuth_beyond(ray, *origin);
      return result;
    }
    h = std::min(h, stepper.largest_step(equations, ray.y));
    if (stops) h = std::min(h, kApproach * left / ray.y[kAzimuthRate]);
    const RayState before = ray.y;
    const double tried = h;
    if (!stepper.try_step(equations, ray.y, h)) continue;
    if (equations.holds(ray.y) && ray.y[kAzimuth] <= until * (1 + kReached)) {
      restore_null_condition(ray);
      continue;
    }
    // The last stage was in the chart but the sum of all stages is not, or the angle was passed.
    ray.y = before;
    h = kRetreat * tried;
    stepper.restart(equations);
  }
  return result;
}

}  // namespace domefall
