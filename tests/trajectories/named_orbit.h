// The orbits that the tables of tests/reference name, by factory and arguments.
#pragma once

#include <map>
#include <string>

#include "trajectories/bound_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/kruskal_crossing.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {

// Throws std::out_of_range for a kind that there is not.
inline Geodesic orbit_named(const std::string& kind, double a, double b, double c) {
  using Factory = Geodesic (*)(double a, double b, double c);
  static const std::map<std::string, Factory> kFactories = {
      {"parabolic_periastron", [](double q, double, double) { return parabolic_by_periastron(q); }},
      {"parabolic_angular_momentum",
       [](double q, double, double) { return parabolic_by_angular_momentum(q); }},
      {"parabolic_excess", [](double q, double, double) { return parabolic_by_excess(q); }},
      {"hyperbolic_periastron",
       [](double q, double s, double) { return hyperbolic_by_periastron(q, s); }},
      {"hyperbolic_speed_excess",
       [](double q, double s, double) { return hyperbolic_by_speed_excess(q, s); }},
      {"hyperbolic_impact",
       [](double q, double s, double) { return hyperbolic_by_impact_parameter(q, s); }},
      {"hyperbolic_impact_excess",
       [](double q, double s, double) { return hyperbolic_by_impact_excess(q, s); }},
      {"bound_turning_points",
       [](double q, double s, double) { return bound_by_turning_points(q, s); }},
      {"bound_shape", [](double q, double s, double) { return bound_by_shape(q, s); }},
      {"bound_excess", [](double q, double s, double) { return bound_by_excess(q, s); }},
      {"rest", [](double q, double s, double) { return fall_from_rest(q, s); }},
      {"infinity", [](double q, double s, double) { return fall_from_infinity(q, s); }},
      {"speed", [](double q, double s, double t) { return fall_with_speed(q, s, t); }},
      {"thrown", [](double q, double s, double t) { return thrown_outside(q, s, t); }},
      {"rain", [](double q, double s, double t) { return thrown_from_rain(q, s, t); }},
      {"crossing", [](double q, double s, double) { return kruskal_crossing(q, s); }}};
  return kFactories.at(kind)(a, b, c);
}

}  // namespace domefall
