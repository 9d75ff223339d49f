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

}  // namespace domefall
