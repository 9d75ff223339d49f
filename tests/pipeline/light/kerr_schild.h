// Rays by Hamilton's equations (pipeline/report/reference/kerr_schild.h), to 13 digits.
#pragma once

#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "pipeline/report/reference/kerr_schild.h"

namespace domefall {

struct KerrSchildRay {
  bool sky;
  double energy;
  V3d place;  // on the sky
};

// Follows light back in time to r = 1e7, or until it is within a part of the horizon's radius.
inline KerrSchildRay kerr_schild_ray(double a, double q, double r, double theta, double delta,
                                     double eta) {
  auto [hole, state] = kerr_schild_start(a, q, r, theta, delta, eta);
  namespace ode = boost::numeric::odeint;
  auto stepper = ode::make_controlled(1e-14, 1e-13, ode::runge_kutta_fehlberg78<KerrSchildState>());
  const double outer = 1 + std::sqrt(1 - a * a - q * q);
  double time = 0, step = 1e-3;
  KerrSchildRay out{true, hole.energy, {}};
  for (int i = 0; i < 20000; ++i) {
    stepper.try_step(hole, state, time, step);
    const double there = hole.radius(state);
    if (there > 1e7) {
      KerrSchildState change;
      hole(state, change, 0);
      out.place = V3d(change[0], change[1], change[2]).normalized();
      return out;
    }
    if (r > outer && there < outer + 1e-3 * (r - outer) && there < outer + 1e-4) break;
  }
  out.sky = false;
  return out;
}

}  // namespace domefall
