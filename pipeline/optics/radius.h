// The observer's radius, in units of M, with its distances from the horizon and from the light
// circle.  A double near 2 or 3 holds those distances badly (2.000001 is off by 1e-10 of its
// altitude), so whoever knows them better gives them; everywhere else a plain number will do.
#pragma once

namespace domefall {

struct Radius {
  double r;
  double above_horizon;       // r - 2
  double above_light_circle;  // r - 3

  Radius(double value)
      : r(value), above_horizon(value - 2), above_light_circle(value - 3) {}  // NOLINT
  // From more digits than a double has.
  explicit Radius(long double value)
      : r(static_cast<double>(value)),
        above_horizon(static_cast<double>(value - 2)),
        above_light_circle(static_cast<double>(value - 3)) {}
};

// r - 2 and r - 3 in a type that may be finer than double: near the place what the radius holds of
// it, elsewhere the difference, which a fine type holds better.
template <class Real>
Real above_horizon_as(const Radius& at) {
  return at.above_horizon * at.above_horizon < 0.01 ? at.above_horizon : Real{at.r} - 2;
}
template <class Real>
Real above_light_circle_as(const Radius& at) {
  return at.above_light_circle * at.above_light_circle < 0.01 ? at.above_light_circle
                                                              : Real{at.r} - 3;
}

}  // namespace domefall
