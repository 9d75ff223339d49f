// Light about a spinning hole by Hamilton's equations in the coordinates of Kerr and Schild, x + iy = (r
// + ia) exp(i phi) sin(theta), which know no horizon, no axis and no constants but H = 0.  It shares
// nothing with what it judges but the tetrad.
#pragma once

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "trajectories/directions.h"

namespace domefall {

// x, y, z, and p_x, p_y, p_z; -p_t is a constant.
using KerrSchildState = std::array<double, 6>;

struct KerrSchild {
  double a, q, energy;

  double radius(const KerrSchildState& s) const {
    const double b = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] - a * a;
    const double root = std::hypot(b, 2 * a * s[2]);
    return std::sqrt(b > 0 ? (b + root) / 2 : 2 * a * a * s[2] * s[2] / (root - b));
  }

  // The metric is flat + f l l, with this l.
  V3d null(const KerrSchildState& s, double r) const {
    const double over = 1 / (r * r + a * a);
    return {(r * s[0] + a * s[1]) * over, (r * s[1] - a * s[0]) * over, s[2] / r};
  }

  double strength(const KerrSchildState& s, double r) const {
    return (2 * r - q * q) * r * r / (r * r * r * r + a * a * s[2] * s[2]);
  }

  // Back in time.
  void operator()(const KerrSchildState& s, KerrSchildState& change, double) const {
    const V3d at(s[0], s[1], s[2]), p(s[3], s[4], s[5]);
    const double r = radius(s), f = strength(s, r), z = s[2], wide = r * r + a * a;
    const double sum = r * r * r * r + a * a * z * z;
    const V3d l = null(s, r),
              up(at.x * r * r * r / sum, at.y * r * r * r / sum, z * r * wide / sum);
    const double along = energy + l.dot(p);
    const V3d velocity = p - l * (f * along);
    for (int j = 0; j < 3; ++j) {
      const double rj = up[j];
      double df = f * (2 / (2 * r - q * q) + 2 / r - 4 * r * r * r / sum) * rj;
      if (j == 2) df -= f * 2 * a * a * z / sum;
      const V3d dl((rj * at.x + r * (j == 0) + a * (j == 1) - 2 * r * rj * l.x) / wide,
                   (rj * at.y + r * (j == 1) - a * (j == 0) - 2 * r * rj * l.y) / wide,
                   (j == 2) / r - z * rj / (r * r));
      change[static_cast<std::size_t>(j)] = -velocity[j];
      change[static_cast<std::size_t>(j + 3)] = -(along * along * df / 2 + f * along * dl.dot(p));
    }
  }
};

struct KerrSchildRay {
  bool sky;
  double energy;
  V3d place;  // on the sky
};

// Follows light back in time to r = 1e7, or until it is within a part of the horizon's radius.
inline KerrSchildRay kerr_schild_ray(double a, double q, double r, double theta, double delta,
                                     double eta) {
  const double s = std::sin(theta), c = std::cos(theta), sigma = r * r + a * a * c * c;
  const double root = std::sqrt(sigma), gap = r * r - 2 * r + a * a + q * q;
  const double n = 1 + std::cos(delta), l = (1 - std::cos(delta)) / 2;
  // k = l n + n l + ..., n.l = 1: its parts along n = -d/dr and l are l.k and n.k
  const double sine = std::sin(delta), up = sine * std::cos(eta), side = sine * std::sin(eta);
  const double kv = n * (r * r + a * a) / sigma + side * a * s / root;
  const double kr = n * gap / (2 * sigma) - l, kt = up / root;
  const double kp = n * a / sigma + side / (s * root);
  KerrSchildState state{r * s, a * s, r * c, 0, 0, 0};
  const V3d k(kr * s + r * c * kt - a * s * kp, a * c * kt + r * s * kp, kr * c - r * s * kt);
  KerrSchild hole{a, q, 0};
  const V3d null = hole.null(state, r);
  const double f = hole.strength(state, r), along = (kv - kr) + null.dot(k);
  const V3d p = k + null * (f * along);
  hole.energy = (kv - kr) - f * along;
  for (int j = 0; j < 3; ++j) state[static_cast<std::size_t>(j + 3)] = p[j];
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
