#include <algorithm>
#include <cmath>

#include "pipeline/light/kerr_path.h"

namespace domefall {
namespace {

using Long = long double;

// A polynomial b1 rho + b0, or that much of one.
struct Line {
  Long first, zero;
};

// Returns the d of d (rho^2 + e1 rho + e0) = rest, all modulo rho^2 + b1 rho + b0.
Line divided(const Line& rest, const KerrRoots& roots) {
  const Long b1 = roots.b1.v, b0 = roots.b0.v;
  const Long m = roots.e1.v - b1, n = roots.e0.v - b0;
  const Long own = n - m * b1, det = n * own + m * m * b0;
  return {(rest.first * n - rest.zero * m) / det, (rest.zero * own + rest.first * m * b0) / det};
}

// Returns the largest z = (r_1 + r_2)^2, a root of the resolvent cubic.
Long largest_resolvent(Long k, Long p, Long linear) {
  const auto f = [&](Long z) { return ((z + 2 * p) * z + linear) * z - 4 * k * k; };
  Long low = 0;
  Long high = 2 * std::max({std::abs(2 * p), std::sqrt(std::abs(linear)), std::cbrt(4 * k * k)});
  Long z = high;
  for (int i = 0; i < 200; ++i) {
    (f(z) > 0 ? high : low) = z;
    Long next = z - f(z) / ((3 * z + 4 * p) * z + linear);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - z) <= 1e-14L * z) return next;
    z = next;
  }
  return z;
}

}  // namespace

KerrRoots kerr_roots(const KerrStart& start) {
  const CriticalRay& edge = start.edge;
  const Long x = edge.x, s = start.side, dk = start.kappa_less_edge;
  const Long g = 2 * s * dk, h = dk * (2 * edge.kappa + dk), t = edge.root;
  const Long a2 = edge.curvature - g - h, a1 = -2 * x * g - 2 * edge.above_one * h;
  const Long a0 = -g * edge.kappa * t - h * t * t + s * s * dk * dk;
  // r^4 + p r^2 + 2k r + ..., first in r.
  const Long kappa = std::max(std::abs(start.kappa.v), Long{1e-15});
  const Long k = kappa * kappa, inner = start.at.sigma() - start.mu.v, p = 2 * inner - k;
  const Long z = largest_resolvent(k, p, k * (k - 4 * inner + 4 * start.at.hole.squares()));
  const Long sum = std::sqrt(z), product = (p + z + 2 * k / sum) / 2;
  KerrRoots out;
  Long& b1 = out.b1.v;
  Long& b0 = out.b0.v;
  b1 = 2 * x - sum;
  b0 = x * x - sum * x + product;
  for (int i = 0; i < 4; ++i) {
    out.e1.v = 4 * x - b1;
    out.e0.v = a2 - b0 - b1 * out.e1.v;
    const Line rest{a1 - b1 * out.e0.v - b0 * out.e1.v, a0 - b0 * out.e0.v};
    const Line step = divided(rest, out);
    b1 += step.first;
    b0 += step.zero;
  }
  out.e1.v = 4 * x - b1;
  out.e0.v = a2 - b0 - b1 * out.e1.v;
  // d(r'^2) = -2 P d(mu) - Delta d(kappa^2).
  const auto change = [&](Long Scaled::*by) {
    const Long dmu = -2 * (start.mu.*by), dk2 = -2 * start.kappa.v * (start.kappa.*by);
    const Long px = edge.kappa * t - s * dk;
    const Long d2 = dmu + dk2, d1 = 2 * x * dmu + 2 * edge.above_one * dk2;
    const Long d0 = dmu * px + dk2 * t * t;
    // modulo the first pair
    const Line step = divided({d1 - d2 * b1, d0 - d2 * b0}, out);
    out.b1.*by = step.first;
    out.b0.*by = step.zero;
    out.e1.*by = -step.first;
    out.e0.*by = d2 - step.zero - step.first * out.e1.v + b1 * step.first;
  };
  change(&Scaled::by_delta);
  change(&Scaled::by_eta);
  return out;
}

}  // namespace domefall
