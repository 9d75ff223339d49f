// A Radius is the observer's, in units of M, with its distances from the horizon and from the light
// circle.  A double near 2 or 3 holds those distances badly (2.000001 is off by 1e-10 of its
// altitude), so whoever knows them better gives them.  Everywhere else a plain number will do.
#pragma once

#include <limits>

namespace domefall {

// This is the radius of an observer in flat space.  Every formula has its limit there.
inline constexpr double kFlatSpace = std::numeric_limits<double>::infinity();

struct Radius {
  double r;
  double above_horizon;       // r - 2
  double above_light_circle;  // r - 3

  Radius(double value)
      : r(value), above_horizon(value - 2), above_light_circle(value - 3) {}  // NOLINT
  // Takes all three from whoever knows them.
  Radius(double value, double horizon, double light_circle)
      : r(value), above_horizon(horizon), above_light_circle(light_circle) {}
  // Takes a number with more digits than a double has.
  explicit Radius(long double value)
      : r(static_cast<double>(value)),
        above_horizon(static_cast<double>(value - 2)),
        above_light_circle(static_cast<double>(value - 3)) {}
};

// These return r, r - 2 and r - 3 in a type that may be finer than double.  Near the horizon or the
// light circle they use what the radius holds of the distances, and elsewhere r.
inline bool is_near(double distance) { return distance * distance < 0.01; }

template <class Real>
Real r_as(const Radius& at) {
  if (is_near(at.above_horizon)) return 2 + Real{at.above_horizon};
  return is_near(at.above_light_circle) ? 3 + Real{at.above_light_circle} : Real{at.r};
}
template <class Real>
Real above_horizon_as(const Radius& at) {
  return is_near(at.above_horizon) ? Real{at.above_horizon} : r_as<Real>(at) - 2;
}
template <class Real>
Real above_light_circle_as(const Radius& at) {
  return is_near(at.above_light_circle) ? Real{at.above_light_circle} : r_as<Real>(at) - 3;
}

}  // namespace domefall
