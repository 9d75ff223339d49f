#include "pipeline/light/kerr_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace domefall {
namespace {

using Long = long double;

// Returns sqrt Delta(x) of light that circles, from
//
//     (x^2 + sigma)(x - 1) - 2x Delta(x) = 2 s x sqrt Delta(x)
//
// with x - 1 = sqrt(Delta + d^2), sigma = a^2 cos^2(theta) and s = a sin(theta) sin(eta).
template <class Real>
Real circling_root(Real sigma, Real d, Real s, Real guess) {
  Real low = 0, high = 3, t = guess;
  for (int i = 0; i < 100; ++i) {
    const Real h = std::sqrt(t * t + d * d), x = 1 + h;
    const Real f = (x * x + sigma) * h - 2 * x * t * (t + s);
    const Real df = t / h * (2 * x * h + x * x + sigma - 2 * t * (t + s)) - 2 * x * (2 * t + s);
    (f > 0 ? low : high) = t;
    Real next = t - f / df;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const Real step = std::abs(next - t);
    t = next;
    if (step <= 4 * std::numeric_limits<Real>::epsilon() * t) break;
  }
  return t;
}

// The same, found in double first, which is quicker.
Long circling_root(Long sigma, Long d, Long s) {
  const auto near = circling_root<double>(static_cast<double>(sigma), static_cast<double>(d),
                                          static_cast<double>(s), 1.7);
  return circling_root<Long>(sigma, d, s, near);
}

// What a ray starts from, so that each sine is found once.
struct Angles {
  Long sin_theta, cos_theta, sin_eta, cos_eta;
  Long sigma, root;  // a^2 cos^2(theta), (r^2 + sigma)^(1/2)

  Angles(const KerrPlace& at, Long eta)
      : sin_theta(std::sin(at.theta)),
        cos_theta(std::cos(at.theta)),
        sin_eta(std::sin(eta)),
        cos_eta(std::cos(eta)) {
    const Long part = at.hole.spin * cos_theta;
    sigma = part * part;
    root = std::sqrt(at.r * at.r + sigma);
  }
};

// Sine and cosine of delta/2 and of the edge's, and their distance.
struct NearEdge {
  Long sine, cosine;
  Long apart;  // sin((delta - edge)/2)
  Long edge_sine, edge_cosine;
};

NearEdge near_edge(const CriticalRay& edge, Long offset, Long root) {
  const Long whole = std::hypot(edge.tau, root), sine = edge.tau / whole, cosine = root / whole;
  const Long by_sine = std::sin(offset / 2), by_cosine = std::cos(offset / 2);
  return {sine * by_cosine + cosine * by_sine, cosine * by_cosine - sine * by_sine, by_sine, sine,
          cosine};
}

void set_constants(KerrStart& out, const NearEdge& half, const Angles& angles) {
  const KerrPlace& at = out.at;
  const CriticalRay& edge = out.edge;
  const Long s = half.sine, c = half.cosine, delta_r = at.delta();
  const Long root = angles.root, big = at.r * at.r + angles.sigma, sin_delta = 2 * s * c;
  const Long sign = out.mirrored ? -1 : 1, sine = sign * angles.sin_eta, cosine = angles.cos_eta;
  const Long axis = at.hole.spin * angles.sin_theta;
  out.side = axis * sine;
  // D is Sigma |E|.
  const auto d_of = [&](Long sin_half, Long cos_half) {
    return sign * (big * sin_half * sin_half + delta_r * cos_half * cos_half) +
           2 * out.side * root * sin_half * cos_half;
  };
  const Long d = d_of(s, c), edge_d = d_of(half.edge_sine, half.edge_cosine);
  out.energy = sign * d / big;
  // With nu = tau - tau_e: Delta - tau_e^2 = 2 X tau_e/kappa, without cancellation.
  const Long cc = c * half.edge_cosine, nu = root * half.apart;  // nu c c_e
  out.kappa_less_edge =
      sign * 2 * big * nu * edge.tau * (2 * edge.far / edge.kappa * cc - nu) / (d * edge_d);
  // (Delta c^2 - Sigma s^2) is c^2 (Delta - tau^2).
  const Long tau_c = root * s;  // tau c
  const Long near =
      c * c * 2 * edge.far * edge.tau / edge.kappa - nu / half.edge_cosine * (tau_c + c * edge.tau);
  const Long fall = std::abs(half.apart) < 0.1L ? near : delta_r * c * c - big * s * s;
  const Long over = big * root / d;  // kappa/sin(delta)
  const Long d_eta = axis * cosine * root;
  out.kappa.v = over * sin_delta;
  out.kappa.by_delta = sign * over * fall / d;
  out.kappa.by_eta = -out.kappa.v * d_eta / d;
  out.mu.v = out.side * out.kappa.v;
  out.mu.by_delta = out.side * out.kappa.by_delta;
  out.mu.by_eta = out.side * out.kappa.by_eta + axis * cosine * over;
  out.speed.v = fall * big / d;
  const Long d_delta = sign * (big - delta_r) * s * c + out.side * root * (c - s) * (c + s);
  out.speed.by_delta = -((big + delta_r) * s * c * big + out.speed.v * d_delta) / d;
  out.speed.by_eta = -out.speed.v * d_eta / d;
  out.polar = {out.kappa.v * cosine, out.kappa.by_delta * cosine,
               out.kappa.by_eta * cosine - over * sine};
  out.azimuthal = {out.kappa.v * sine + axis, out.kappa.by_delta * sine,
                   out.kappa.by_eta * sine + over * cosine};
}

CriticalRay critical_ray(const KerrPlace& at, const Angles& angles, KerrEdge edge) {
  const bool third = edge == KerrEdge::kRegionThree;
  const Long s = at.hole.spin * angles.sin_theta * angles.sin_eta * (third ? -1 : 1);
  const Long d = at.hole.horizon_distance();
  CriticalRay out;
  out.root = circling_root(angles.sigma, d, s);
  out.above_one = std::hypot(out.root, d);
  const Long x = out.x = 1 + out.above_one;
  const Long cosine = out.root / out.above_one;
  out.kappa = 2 * x * cosine;
  out.curvature = 4 * x * (out.above_one + (1 - cosine) * (1 + cosine));
  out.rho = (at.r - 1) - out.above_one;
  out.far = out.rho * std::sqrt(std::max(Long{0}, out.rho * (out.rho + 4 * x) + out.curvature));
  const Long p = out.rho * (at.r + x) + out.kappa * out.root, delta_r = at.delta();
  if (third) {
    out.tau = p > 0 ? -out.kappa * delta_r / (p - out.far) : -(p + out.far) / out.kappa;
  } else {
    out.tau =
        p > 0 && out.far > 0 ? out.kappa * delta_r / (p + out.far) : (p - out.far) / out.kappa;
  }
  out.delta = 2 * std::atan2(out.tau, angles.root);
  return out;
}

}  // namespace

Long KerrPlace::sigma() const {
  const Long part = hole.spin * std::cos(theta);
  return part * part;
}

CriticalRay critical_ray(const KerrPlace& at, Long eta, KerrEdge edge) {
  return critical_ray(at, Angles(at, eta), edge);
}

KerrStart kerr_start(const KerrPlace& at, const KerrDirection& direction) {
  KerrStart out{};
  out.at = at;
  const Angles angles(at, direction.eta);
  out.sine = angles.sin_theta, out.cosine = angles.cos_theta, out.sigma = angles.sigma;
  const bool by_third = direction.edge == KerrEdge::kRegionThree;
  out.edge = critical_ray(at, angles, KerrEdge::kSilhouette);
  const bool within = at.delta() < 0;
  const CriticalRay third =
      within ? critical_ray(at, angles, KerrEdge::kRegionThree) : CriticalRay{};
  Long delta = direction.delta, apart = delta - out.edge.delta, from_third = delta - third.delta;
  if (direction.edge) {
    delta = (by_third ? third : out.edge).delta + direction.offset;
    apart = by_third ? delta - out.edge.delta : direction.offset;
    from_third = by_third ? direction.offset : delta - third.delta;
  }
  out.origin = apart > 0 ? KerrOrigin::kOwn : KerrOrigin::kPastHorizon;
  if (within && apart <= 0) {
    if (from_third < 0) out.origin = KerrOrigin::kParallel;
    const Long s = angles.root * std::sin(delta / 2), c = std::cos(delta / 2);
    const Long side = at.hole.spin * angles.sin_theta * angles.sin_eta;
    out.mirrored = s * (s + 2 * side * c) + at.delta() * c * c < 0;
    if (out.mirrored) out.edge = third, apart = from_third;
  }
  set_constants(out, near_edge(out.edge, apart, angles.root), angles);
  return out;
}

}  // namespace domefall
