// The free falls of one kind of hole, by one set of names.  What an orbit is given by is said in
// docs/show-format.md.  All throw std::domain_error for an orbit that does not exist.
#pragma once

#include <cmath>

#include "trajectories/bound_orbit.h"
#include "trajectories/charged_orbit.h"
#include "trajectories/hyperbolic_orbit.h"
#include "trajectories/infall.h"
#include "trajectories/parabolic_orbit.h"

namespace domefall {

struct PlainFalls {
  static auto parabola(double periastron) { return parabolic_by_periastron(periastron); }
  static auto parabola_by_momentum(double l) { return parabolic_by_angular_momentum(l); }
  static auto parabola_by_excess(double excess) { return parabolic_by_excess(excess); }

  static auto hyperbola(double v, double periastron) {
    return hyperbolic_by_periastron(v, periastron);
  }
  static auto hyperbola_by_impact(double v, double b) {
    return hyperbolic_by_impact_parameter(v, b);
  }
  static auto hyperbola_by_speed_excess(double periastron, double excess) {
    return hyperbolic_by_speed_excess(periastron, excess);
  }
  static auto hyperbola_by_impact_excess(double v, double excess) {
    return hyperbolic_by_impact_excess(v, excess);
  }

  static auto ellipse(double low, double high) { return bound_by_turning_points(low, high); }
  static auto ellipse_by_shape(double p, double e) { return bound_by_shape(p, e); }
  static auto ellipse_by_excess(double e, double excess) { return bound_by_excess(e, excess); }

  static auto fall(double l, double from_r) { return fall_from_infinity(l, from_r); }
  static auto fall_at(double v, double b, double from_r) { return fall_with_speed(v, b, from_r); }
  static auto drop(double rest_r, double l) { return fall_from_rest(rest_r, l); }
  static auto throw_from_rest(double r, double radial, double across) {
    return thrown_outside(r, radial, across);
  }
  static auto throw_from_tetrad(double r, double radial, double across) {
    return thrown_from_rain(r, radial, across);
  }
  // Says whether what is thrown so is mirrored, which a Geodesic is by itself.
  static bool is_mirrored_throw(double, double, double) { return false; }
};

struct ChargedFalls {
  ChargedHole hole;

  static double excess_of(double v) { return v * v / ((1 - v) * (1 + v)); }

  auto parabola(double periastron) const {
    return ChargedOrbit::by_periastron(hole, periastron, 0);
  }
  auto parabola_by_momentum(double l) const { return ChargedOrbit::scattered(hole, 0, l); }
  auto parabola_by_excess(double excess) const {
    return ChargedOrbit::by_momentum_excess(hole, 0, excess);
  }

  auto hyperbola(double v, double periastron) const {
    return ChargedOrbit::by_periastron(hole, periastron, excess_of(v));
  }
  auto hyperbola_by_impact(double v, double b) const {
    return ChargedOrbit::scattered(hole, excess_of(v), b * std::sqrt(excess_of(v)));
  }
  auto hyperbola_by_speed_excess(double periastron, double excess) const {
    return ChargedOrbit::by_speed_excess(hole, periastron, excess);
  }
  auto hyperbola_by_impact_excess(double v, double excess) const {
    return ChargedOrbit::by_momentum_excess(hole, excess_of(v), excess);
  }

  auto ellipse(double low, double high) const { return ChargedOrbit::between(hole, low, high); }
  auto ellipse_by_shape(double p, double e) const { return ChargedOrbit::by_shape(hole, p, e); }
  auto ellipse_by_excess(double e, double excess) const {
    return ChargedOrbit::by_shape_excess(hole, e, excess);
  }

  auto fall(double l, double from_r) const { return ChargedOrbit::falling(hole, from_r, 0, l); }
  auto fall_at(double v, double b, double from_r) const {
    return ChargedOrbit::falling(hole, from_r, excess_of(v), b * std::sqrt(excess_of(v)));
  }
  auto drop(double rest_r, double l) const { return ChargedOrbit::from_rest(hole, rest_r, l); }
  auto throw_from_rest(double r, double radial, double across) const {
    return ChargedOrbit::thrown(hole, r, radial, across);
  }
  auto throw_from_tetrad(double r, double radial, double across) const {
    return ChargedOrbit::thrown_from_tetrad(hole, r, radial, across);
  }
  bool is_mirrored_throw(double r, double radial, double across) const {
    return ChargedOrbit::has_negative_energy(hole, r, radial, across);
  }
};

// Calls read(falls) with those of the stage's hole, for what it returns.
template <class Read>
auto with_falls(const Spacetime& spacetime, const Read& read) {
  const auto* charged = std::get_if<ChargedHole>(&spacetime.kind());
  return charged ? read(ChargedFalls{*charged}) : read(PlainFalls{});
}

}  // namespace domefall
