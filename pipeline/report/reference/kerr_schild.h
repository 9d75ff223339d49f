// Light about a spinning hole by Hamilton's equations in the coordinates of Kerr and Schild, x + iy = (r
// + ia) exp(i phi) sin(theta), which know no horizon, no axis and no constants but H = 0.  It shares
// nothing with what it judges but the tetrad T (pipeline/light/kerr_start.h).
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cmath>

namespace domefall {

using Imath::V3d;

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

struct KerrSchildStart {
  KerrSchild hole;
  KerrSchildState state;
};

// Returns the photon k = T + cos(delta) R + sin(delta) (cos(eta) Theta + sin(eta) Phi) as it reaches an
// observer at r and theta, and phi = 0 in the angle of light that falls.
inline KerrSchildStart kerr_schild_start(double a, double q, double r, double theta, double delta,
                                         double eta) {
  const double s = std::sin(theta), c = std::cos(theta), sigma = r * r + a * a * c * c;
  const double root = std::sqrt(sigma), gap = r * r - 2 * r + a * a + q * q;
  const double n = 1 + std::cos(delta), l = (1 - std::cos(delta)) / 2;
  // k = l n + n l + ..., n.l = 1: its parts along n = -d/dr and l are l.k and n.k
  const double sine = std::sin(delta), up = sine * std::cos(eta), side = sine * std::sin(eta);
  const double kv = n * (r * r + a * a) / sigma + side * a * s / root;
  const double kr = n * gap / (2 * sigma) - l, kt = up / root;
  const double kp = n * a * s / sigma + side / root;  // sin(theta) of it, which has no axis
  KerrSchildState state{r * s, a * s, r * c, 0, 0, 0};
  const V3d k(kr * s + r * c * kt - a * kp, a * c * kt + r * kp, kr * c - r * s * kt);
  KerrSchild hole{a, q, 0};
  const V3d null = hole.null(state, r);
  const double f = hole.strength(state, r), along = (kv - kr) + null.dot(k);
  const V3d p = k + null * (f * along);
  hole.energy = (kv - kr) - f * along;
  for (int j = 0; j < 3; ++j) state[static_cast<std::size_t>(j + 3)] = p[j];
  return {hole, state};
}

}  // namespace domefall
